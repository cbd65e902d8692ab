"""The set of orientations a problem names, whatever it was written as."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from timelaw.errors import Fault, InputError, list_some
from timelaw.numerics.array import Array, freeze
from timelaw.numerics.quaternion import multiply
from timelaw.orientations.angle_files import READERS, read_angles
from timelaw.orientations.attitude_files import ATTITUDE_READERS
from timelaw.orientations.equivalence import find_equivalents, make_rotation_group
from timelaw.orientations.forms import (
    Writing,
    describe_translations,
    find_fault,
    find_precision,
    make_quaternions,
)
from timelaw.orientations.lattices import make_lattice
from timelaw.orientations.precision import EXACT, Precision
from timelaw.orientations.spread import measure_covering_radius, measure_separation
from timelaw.orientations.table import read_table
from timelaw.orientations.uniform import make_uniform
from timelaw.problem.route import Orientations

TRAJECTORY, TRAJECTORY_COLUMNS = ".tum", (5, 6, 7, 8)  # t, place, quaternion with the scalar last


@dataclass(frozen=True)
class OrientationSet:
    """Unit quaternions (N, 4), copied and read-only, with one label each.

    `lattice` names the polytope whose vertices they are, turned or not, if any.
    `same` pairs labels of orientations that are one up to sign, `merged` those of which the second is left
    out for the first; `notes` say what was left out or merged; `precision` is how far each may be from what
    was meant.
    """

    quaternions: Array
    labels: tuple[str, ...]
    source: str
    lattice: str | None = None
    same: tuple[tuple[str, str], ...] = ()
    merged: tuple[tuple[str, str], ...] = ()
    notes: tuple[str, ...] = ()
    precision: Precision = EXACT

    def __post_init__(self) -> None:
        object.__setattr__(self, "quaternions", freeze(self.quaternions))

    def __len__(self) -> int:
        return len(self.labels)


def read_orientations(spec: Orientations, folder: Path) -> OrientationSet:
    """Resolve what the problem file says; file paths are relative to `folder`.

    Raises:
        InputError: a row of the list or table is wrong, or too few orientations are left.
    """
    found = _read(spec, folder)
    if spec.only is not None:
        found = take_part(found, spec.only)
    if spec.turned is not None:
        turned = multiply(multiply(spec.turned.world, found.quaternions), spec.turned.body)
        turned /= np.linalg.norm(turned, axis=1, keepdims=True)
        found = replace(found, quaternions=turned)
    if spec.precision is not None:
        found = replace(found, precision=Precision(spec.precision, "as given"))
    return _merged(found, spec)


def _read(spec: Orientations, folder: Path) -> OrientationSet:
    """The orientations as they are written."""
    if spec.lattice is not None:
        points = make_lattice(spec.lattice)
        return OrientationSet(points, _numbers(len(points)), spec.lattice, spec.lattice)
    if spec.uniform is not None:
        points, name = make_uniform(spec.uniform.fill)
        apart, fill = np.degrees([measure_separation(points), measure_covering_radius(points)])
        spread = f"separation {apart:.2f}°, covering radius {fill:.2f}°"
        note = f"{name or 'super-Fibonacci spiral'} of {len(points)} orientations, {spread}"
        return OrientationSet(points, _numbers(len(points)), name or "uniform", name, notes=(note,))
    writing = None
    if spec.form is not None:
        writing = Writing(spec.form, spec.sequence or "ZXZ", spec.unit or "rad")
    if spec.file is not None:
        return _from_file(spec, folder / spec.file, writing)
    rows = spec.list or ()
    for index, row in enumerate(rows):
        wrong = find_fault(row, writing or Writing())
        if wrong:
            raise InputError(Fault(wrong, f"route.orientations.list[{index + 1}]"))
    points = make_quaternions(rows, writing or Writing())
    precision = find_precision(rows, writing or Writing())
    notes = describe_translations(rows, writing or Writing(), "the list")
    return OrientationSet(points, _numbers(len(points)), "list", precision=precision, notes=notes)


def _from_file(spec: Orientations, path: Path, writing: Writing | None) -> OrientationSet:
    """A table, or the angle file of a texture tool, known by its ending."""
    source = spec.file or ""
    if path.suffix.lower() in READERS and writing is None:
        if spec.columns is not None:
            message = f'{path.suffix} files have their own columns; give "as" too, or leave "columns" away'
            raise InputError(Fault(message, "route.orientations.columns"))
        read = read_angles(path, spec.unit, spec.phase)
        notes = []
        if read.unindexed:
            notes.append(f"{read.unindexed} points of {source} were not indexed and are left out")
        if read.other_phases:
            notes.append(f"{read.other_phases} points of {source} are of other phases and are left out")
        return OrientationSet(read.quaternions, read.labels, source, notes=tuple(notes))
    if path.suffix.lower() in ATTITUDE_READERS and writing is None:
        points, told = ATTITUDE_READERS[path.suffix.lower()](path)
        return OrientationSet(points, _numbers(len(points)), source, notes=told)
    columns = spec.columns
    if path.suffix.lower() == TRAJECTORY and writing is None and columns is None:
        writing, columns = Writing("xyzw"), TRAJECTORY_COLUMNS
    table = read_table(path, writing, columns)
    labels = table.labels or _numbers(len(table.quaternions))
    return OrientationSet(table.quaternions, labels, source, precision=table.precision, notes=table.notes)


def take_part(found: OrientationSet, wanted: Sequence[str]) -> OrientationSet:
    """Those of some labels, or of ranges "first-last" of them, in the order of the set.

    Raises:
        InputError: there is no such label, or fewer than two are left.
    """
    where = "route.orientations.only"
    index = {label: i for i, label in enumerate(found.labels)}
    taken: set[int] = set()
    for text in wanted:
        ends = [text, text] if text in index else [part.strip() for part in text.split("-", 1)]
        missing = next((end for end in ends if end not in index), None)
        if missing is not None or len(ends) < 2 or index[ends[0]] > index[ends[1]]:
            there = list_some(found.labels)
            raise InputError(Fault(f'"{text}" is no label, nor a range of them; there are {there}', where))
        taken.update(range(index[ends[0]], index[ends[1]] + 1))
    if len(taken) < 2:
        raise InputError(Fault(f"{len(taken)} orientations; at least two are needed", where))
    if len(taken) == len(found):
        return found
    kept = sorted(taken)
    labels = tuple(found.labels[i] for i in kept)
    note = f"{len(kept)} of the {len(found)} orientations of {found.source} are taken"
    points = found.quaternions[kept]
    return replace(found, quaternions=points, labels=labels, lattice=None, notes=(*found.notes, note))


def _merged(found: OrientationSet, spec: Orientations) -> OrientationSet:
    """Without those that are the same, if that is asked for; otherwise they are only named."""
    group = make_rotation_group(spec.symmetry) if spec.symmetry is not None else None
    if found.lattice is not None and group is None:
        return found  # vertices of a polytope are apart
    first = find_equivalents(found.quaternions, max(spec.tolerance, found.precision.angle), group)
    pairs = tuple((found.labels[j], found.labels[i]) for i, j in enumerate(first) if i != j)
    if not pairs:
        return found
    if spec.duplicates is None and group is None:
        return replace(found, same=pairs)
    kept = [i for i, j in enumerate(first) if i == j]
    if len(kept) < 2:
        raise InputError(
            Fault("all orientations are the same; at least two are needed", "route.orientations")
        )
    under = f" under {spec.symmetry}" if group is not None else ""
    listing = list_some([f"{other} is {one}" for one, other in pairs])
    note = f"{len(pairs)} of {len(first)} orientations are merged{under}: {listing}"
    labels = tuple(found.labels[i] for i in kept)
    points = found.quaternions[kept]
    return replace(
        found, quaternions=points, labels=labels, lattice=None, merged=pairs, notes=(*found.notes, note)
    )


def _numbers(count: int) -> tuple[str, ...]:
    return tuple(str(i + 1) for i in range(count))
