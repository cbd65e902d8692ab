"""How problem files write orientations: the names of the forms, what else each needs, rows of numbers."""

from itertools import pairwise
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from timelaw.problem.fields import fault
from timelaw.units import MOST

FormName = Literal["wxyz", "xyzw", "rotation-vector", "matrix", "euler", "axis-angle"]
SEQUENCE = r"^([XYZ]{3}|[xyz]{3})$"
NEEDS = {"rotation-vector": ("unit",), "euler": ("sequence", "unit"), "axis-angle": ("unit",)}


def read_numbers(value: Any) -> Any:
    """A row of numbers, or a matrix as three rows."""
    if _is_matrix(value) and [len(row) for row in value] not in ([3, 3, 3], [4, 4, 4], [4, 4, 4, 4]):
        raise fault("a matrix has three rows of three numbers, or with a translation three or four of four")
    flat = [v for row in value for v in row] if _is_matrix(value) else value
    good = isinstance(flat, list) and all(
        isinstance(v, int | float) and not isinstance(v, bool) and abs(v) <= MOST for v in flat
    )
    if not good:
        raise fault("expected a list of numbers, as in [1, 0, 0, 0]")
    return tuple(float(v) for v in flat)


def _is_matrix(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, list) for v in value)


Numbers = Annotated[tuple[float, ...], BeforeValidator(read_numbers)]


def refuse_half_form(form: str | None, keys: dict[str, Any], *, without_form: tuple[str, ...] = ()) -> None:
    """Say which of `unit` and `sequence` a form needs or does not take."""
    for key, value in keys.items():
        needed = key in NEEDS.get(form or "", ())
        if form is None and key in without_form:
            continue
        if needed and value is None:
            raise fault(f'"as: {form}" needs "{key}"', "as")
        if not needed and value is not None:
            users = " or ".join(form for form, needs in NEEDS.items() if key in needs)
            raise fault(f'it belongs to "as: {users}"', key)
    sequence = keys["sequence"]
    if sequence is not None and any(a == b for a, b in pairwise(sequence)):
        raise fault(f'"{sequence}"; two turns in a row about one axis are one turn', "sequence")
