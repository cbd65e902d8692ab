"""The forms in which orientations are written, each turned into unit quaternions (N, 4), scalar first.

All describe the body's attitude, body to world: r_world = R r_body. SciPy's rotations do the work.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import from_axis_angle, normalise
from timelaw.orientations.precision import (
    MATRICES,
    QUATERNIONS,
    Precision,
    measure_precision,
    take_as_exact,
)
from timelaw.problem.fields import NORM_TOLERANCE

MATRIX_COLUMNS = tuple(f"r{i}{j}" for i in "123" for j in "123")
ANGLES = ("rotation-vector", "euler", "axis-angle")  # forms whose numbers have a unit; an axis has any length
MATRIX, HOMOGENEOUS = 9, (12, 16)  # numbers of a rotation matrix, and of one that holds a translation too
LAST_ROW = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Writing:
    """How a file or list writes its orientations: form, sequence of Euler angles, unit of angles."""

    form: str = "wxyz"
    sequence: str = "ZXZ"
    unit: str = "rad"


@dataclass(frozen=True)
class Form:
    """One form: how many numbers, what a row is called, names of its columns, and its conversion.

    `check` says what is wrong with a row of numbers (width,), or nothing; `convert` takes rows
    (N, width), angles in rad, and Euler's sequence; `measure` says how precise rows are. Columns may be
    `numbered`, as q1 to q4 are.
    """

    name: str
    columns: tuple[tuple[str, ...], ...]
    check: Callable[[Array], str]
    convert: Callable[[Array, str], Array]
    measure: Callable[[Array], Precision] = take_as_exact
    numbered: bool = False

    @property
    def width(self) -> int:
        """Numbers of an orientation."""
        return len(self.columns[0])

    @property
    def widths(self) -> tuple[int, ...]:
        """Numbers in a row, which may hold a translation too."""
        return (self.width, *HOMOGENEOUS) if self.width == MATRIX else (self.width,)


def find_fault(row: Sequence[float], writing: Writing) -> str:
    """What is wrong with one row of numbers; empty if nothing is."""
    form = FORMS[writing.form]
    if len(row) not in form.widths:
        return f"expected {form.name}"
    wrong = _check_last_row(row) if len(row) == len(LAST_ROW) ** 2 else ""
    return wrong or form.check(np.array(take_rotation(row)))


def take_rotation(row: Sequence[float]) -> Sequence[float]:
    """A row without the translation of a homogeneous matrix, 4x4 or its upper three rows."""
    return [row[4 * i + j] for i in range(3) for j in range(3)] if len(row) in HOMOGENEOUS else row


def _check_last_row(row: Sequence[float]) -> str:
    if all(abs(a - b) <= NORM_TOLERANCE for a, b in zip(row[12:], LAST_ROW, strict=True)):
        return ""
    turned = all(abs(row[4 * i + 3]) <= NORM_TOLERANCE for i in range(3))
    hint = "; is it written by columns? Then transpose it" if turned else ""
    return f"the last row of a 4x4 matrix is 0, 0, 0, 1, not {', '.join(f'{v:g}' for v in row[12:])}{hint}"


def make_quaternions(rows: Sequence[Sequence[float]], writing: Writing) -> Array:
    """Unit quaternions (N, 4) of rows that have no fault."""
    return convert(np.array([take_rotation(row) for row in rows], dtype=float), writing)


def convert(table: Array, writing: Writing) -> Array:
    """Unit quaternions (N, 4) of rows (N, w) without a fault or a translation."""
    form = FORMS[writing.form]
    if writing.unit == "deg" and writing.form in ANGLES:
        table = np.radians(table)
    found = form.convert(table, writing.sequence)
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


def find_precision(rows: Sequence[Sequence[float]], writing: Writing) -> Precision:
    """How precisely rows that have no fault are written, as their numbers show."""
    return FORMS[writing.form].measure(np.array([take_rotation(row) for row in rows], dtype=float))


def describe_translations(rows: Sequence[Sequence[float]], writing: Writing, source: str) -> tuple[str, ...]:
    """What is said where matrices hold translations too, which are left alone."""
    held = any(len(row) in HOMOGENEOUS for row in rows) and FORMS[writing.form].width == MATRIX
    return (
        f"the translations of the matrices in {source} are ignored: only their rotations are taken",
    ) * held


def _of_norm_one(row: Array) -> str:
    norm = float(np.linalg.norm(row))
    if abs(norm - 1) <= NORM_TOLERANCE:
        return ""
    listing = ", ".join(f"{c:g}" for c in row)
    return f"[{listing}] has norm {norm:.6g}; a unit quaternion"


def _unit_wxyz(row: Array) -> str:
    fault = _of_norm_one(row)
    return f"{fault} [w, x, y, z] is needed" if fault else ""


def _unit_xyzw(row: Array) -> str:
    fault = _of_norm_one(row)
    return f"{fault} [x, y, z, w] is needed" if fault else ""


def _proper(row: Array) -> str:
    """A rotation matrix by rows: RᵀR = 1, det R = 1."""
    matrix = row.reshape(3, 3)
    error = float(np.max(np.abs(matrix.T @ matrix - np.eye(3))))
    if error > 2 * NORM_TOLERANCE:
        return f"not a rotation matrix: RᵀR differs from 1 by {error:.3g}"
    return "not a rotation matrix: its determinant is -1" if np.linalg.det(matrix) < 0 else ""


def _with_axis(row: Array) -> str:
    """An axis of any length but zero, unless nothing turns about it."""
    return "" if np.any(row[:3]) or row[3] == 0 else "the axis [x, y, z] of a turn may not be zero"


def _anything(_: Array) -> str:
    return ""


def _measure_quaternions(rows: Array) -> Precision:
    return measure_precision(rows, QUATERNIONS)


def _measure_matrices(rows: Array) -> Precision:
    return measure_precision(rows, MATRICES)


def _from_vectors(rows: Array, _: str) -> Array:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(rows).as_quat(scalar_first=True))


def _from_matrices(rows: Array, _: str) -> Array:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_matrix(rows.reshape(-1, 3, 3)).as_quat(scalar_first=True))


def _from_euler(rows: Array, sequence: str) -> Array:
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_euler(sequence, rows).as_quat(scalar_first=True))


def _from_axes(rows: Array, _: str) -> Array:
    """(cos(θ/2), n sin(θ/2)), the sign as the angle has it."""
    axes = np.where(np.any(rows[:, :3], axis=1, keepdims=True), rows[:, :3], [1.0, 0.0, 0.0])
    return from_axis_angle(normalise(axes), rows[:, 3])


FORMS: dict[str, Form] = {
    "wxyz": Form(
        "a quaternion of four numbers [w, x, y, z]",
        (("w", "x", "y", "z"), ("qw", "qx", "qy", "qz")),
        _unit_wxyz,
        lambda rows, _: rows,
        _measure_quaternions,
        numbered=True,
    ),
    "xyzw": Form(
        "a quaternion of four numbers [x, y, z, w]",
        (("x", "y", "z", "w"), ("qx", "qy", "qz", "qw")),
        _unit_xyzw,
        lambda rows, _: rows[:, [3, 0, 1, 2]],
        _measure_quaternions,
        numbered=True,
    ),
    "rotation-vector": Form(
        "a rotation vector of three numbers",
        (("rx", "ry", "rz"), ("vx", "vy", "vz")),
        _anything,
        _from_vectors,
    ),
    "matrix": Form(
        "a rotation matrix of nine numbers, row by row",
        (MATRIX_COLUMNS, tuple(name.replace("r", "m") for name in MATRIX_COLUMNS)),
        _proper,
        _from_matrices,
        _measure_matrices,
    ),
    "euler": Form(
        "three Euler angles",
        (("euler1", "euler2", "euler3"), ("phi1", "phi", "phi2"), ("e1", "e2", "e3")),
        _anything,
        _from_euler,
    ),
    "axis-angle": Form(
        "an axis and an angle [x, y, z, angle]",
        (("x", "y", "z", "angle"), ("nx", "ny", "nz", "angle")),
        _with_axis,
        _from_axes,
    ),
}
