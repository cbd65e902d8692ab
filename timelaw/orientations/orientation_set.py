"""The set of orientations a problem names, whatever it was written as."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from timelaw.orientations.lattices import lattice
from timelaw.orientations.table import read_table
from timelaw.problem.model import Orientations

Array = NDArray[np.float64]


@dataclass(frozen=True)
class OrientationSet:
    """Unit quaternions (N, 4), read-only, with one label each; `lattice` names the polytope, if any."""

    quaternions: Array
    labels: tuple[str, ...]
    source: str
    lattice: str | None = None

    def __post_init__(self) -> None:
        self.quaternions.setflags(write=False)

    def __len__(self) -> int:
        return len(self.labels)


def orientations(spec: Orientations, folder: Path) -> OrientationSet:
    """Resolve what the problem file says; file paths are relative to `folder`.

    Raises:
        InputError: the table is missing or wrong.
    """
    if spec.lattice is not None:
        quaternions = lattice(spec.lattice)
        return OrientationSet(quaternions, _numbers(len(quaternions)), spec.lattice, spec.lattice)
    if spec.file is not None:
        quaternions, labels = read_table(folder / spec.file)
        return OrientationSet(quaternions, labels or _numbers(len(quaternions)), spec.file)
    quaternions = np.array(spec.list, dtype=float)
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    return OrientationSet(quaternions, _numbers(len(quaternions)), "list")


def _numbers(count: int) -> tuple[str, ...]:
    return tuple(str(i + 1) for i in range(count))
