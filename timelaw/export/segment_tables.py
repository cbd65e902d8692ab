"""A law as flat tables: pieces, each with the control points of a function of time and its derivatives.

A segment about a fixed axis has the angle φ, φ', φ''; a rational one Q, Q', Q'' (four columns); a motion of
the origin adds P, P' (three). All are Bernstein control points over the piece.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import differentiate
from timelaw.numerics.quaternion import normalise
from timelaw.numerics.state_form import derive

RATES = 3  # of the orientation: itself, and two derivatives in time
POINT_RATES = 2  # of the origin's place
Document = Mapping[str, Any]


@dataclass(frozen=True)
class TablePiece:
    """`length` [s], and control points (n+1, w) of the functions and their derivatives."""

    length: float
    functions: tuple[Array, ...]


@dataclass(frozen=True)
class TableSegment:
    """`start` quaternion (4,) and `axis` (3,) of a turn; pieces; whether they are of a curve Q/|Q|."""

    start: Array
    axis: Array
    pieces: tuple[TablePiece, ...]
    curved: bool

    @property
    def offsets(self) -> list[float]:
        """Where the pieces begin [s], from the segment's start."""
        return list(accumulate((piece.length for piece in self.pieces[:-1]), initial=0.0))


def tabulate_segments(law: QuaternionLaw) -> list[TableSegment]:
    """Every segment, from what the law file says of it."""
    return [TABLES[segment.kind](segment.document()) for segment in law.segments]


def _arc(document: Document) -> TableSegment:
    start, axis = normalise(document["start"]), normalise(document["axis"])
    return TableSegment(start, axis, tuple(_angle(piece) for piece in document["pieces"]), curved=False)


def _angle(piece: Document) -> TablePiece:
    duration = float(piece["duration"])
    form = np.array([duration]), np.array([piece["state"]]), np.array([piece["bernstein"]])
    return TablePiece(duration, tuple(derive(*form, order)[0].T for order in range(RATES)))


def _dwell(document: Document) -> TableSegment:
    """No turn, about any axis."""
    still = tuple(np.zeros((1, 1)) for _ in range(RATES))
    point = document.get("point")
    place = () if point is None else (np.array([point]), np.zeros((1, 3)))
    piece = TablePiece(document["duration"], (*still, *place))
    return TableSegment(normalise(document["orientation"]), np.eye(3)[0], (piece,), curved=False)


def _rational(document: Document) -> TableSegment:
    pieces = []
    for piece in document["pieces"]:
        functions = list_derivatives(piece["control"], piece["duration"], RATES)
        if "points" in piece:
            functions += list_derivatives(piece["points"], piece["duration"], POINT_RATES)
        pieces.append(TablePiece(piece["duration"], tuple(functions)))
    return TableSegment(normalise(document["start"]), np.eye(3)[0], tuple(pieces), curved=True)


def list_derivatives(control: Sequence[Sequence[float]], duration: float, count: int) -> list[Array]:
    """Control points (n+1, w) of a curve over `duration` and of its derivatives in time."""
    columns = np.array(control, dtype=float).T
    return [(differentiate(columns, order) / duration**order).T for order in range(count)]


TABLES: dict[str, Callable[[Document], TableSegment]] = {"arc": _arc, "dwell": _dwell, "rational": _rational}
