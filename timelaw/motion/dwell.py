"""Segments of kind `dwell`: the body rests at a node."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, ClassVar, Literal

import numpy as np

from timelaw.easing.profile import Side
from timelaw.limits import Bounds, Limit
from timelaw.limits.formula import Vector
from timelaw.limits.row_peaks import RowPeak
from timelaw.motion.schema import Duration, Number, Part, Text, Vector3, Vector4
from timelaw.motion.segment import RATES, Discrepancy, Edges, Quantity
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import normalise


class DwellDocument(Part):
    """What a law file says of a dwell."""

    kind: Literal["dwell"]
    at: Text
    start_time: Number
    duration: Duration
    orientation: Vector4
    point: Vector3 | None = None


@dataclass(frozen=True)
class Dwell:
    """q(t) = `orientation` (4,), over its norm, for `duration` [s] from `start_time`, at the node `at`.

    In a motion with a translation the body's origin is at `point` (3,) [m].
    """

    kind: ClassVar[str] = "dwell"
    moves: ClassVar[bool] = False
    fineness: ClassVar[float] = 0.0
    own_limits: ClassVar[tuple[str, ...]] = ()
    document_model: ClassVar[type[Part]] = DwellDocument
    breaks: ClassVar[Array] = np.array([0.0, 1.0])
    even_breaks: ClassVar[Array] = breaks
    limits: ClassVar[Mapping[str, Bounds]] = MappingProxyType({})

    at: str
    start_time: float
    duration: float
    orientation: Array
    point: Array | None = None

    @property
    def name(self) -> str:
        """How reports call the segment."""
        return f"dwell at {self.at}"

    @property
    def origin(self) -> str:
        """The node's label."""
        return self.at

    target = origin

    @property
    def start(self) -> Array:
        """Orientation at the first instant."""
        return self.orientation

    end = start

    @property
    def end_time(self) -> float:
        """Instant [s] at which the segment ends."""
        return self.start_time + self.duration

    def __call__(self, tau: Array, order: int, side: Side) -> Array:  # noqa: ARG002
        """The orientation (m, 4) for order 0, else zeros (m, 3)."""
        size = np.shape(tau)
        if order:
            return np.zeros((*size, 3))
        return np.broadcast_to(normalise(self.orientation), (*size, 4)).copy()

    @property
    def travels(self) -> bool:
        """Whether it says where the origin is."""
        return self.point is not None

    def place(self, tau: Array, order: int, side: Side) -> Array:  # noqa: ARG002
        """The point (m, 3) for order 0, else zeros."""
        found = np.zeros((*np.shape(tau), 3))
        return found if order or self.point is None else found + self.point

    def axis_at(self, end: int) -> None:  # noqa: ARG002
        """Nothing turns."""
        return

    @classmethod
    def integrate_squares(cls, segments: Sequence["Dwell"], order: int) -> float:  # noqa: ARG003
        """Nothing moves."""
        return 0.0

    @classmethod
    def list_edges(cls, segments: Sequence["Dwell"]) -> list[Edges]:
        """Nothing moves, and there is no break inside."""
        count = len(RATES)
        return [Edges(np.zeros((count, 2, 3)), np.zeros((count, 0, 3)), np.zeros(count))] * len(segments)

    @classmethod
    def find_largest(cls, segments: Sequence["Dwell"]) -> Array:  # noqa: ARG003
        """Nothing moves."""
        return np.zeros(len(RATES))

    @classmethod
    def find_peaks(
        cls,
        segments: Sequence["Dwell"],
        limits: Sequence[Sequence[Limit]],  # noqa: ARG003
        total: Vector,  # noqa: ARG003
    ) -> list[list[RowPeak]]:
        """Nothing at rest is limited."""
        return [[] for _ in segments]

    @classmethod
    def find_own_peaks(cls, segments: Sequence["Dwell"]) -> list[list[RowPeak]]:
        """None."""
        return [[] for _ in segments]

    def list_deviations(self, bound: float = 0.0) -> Iterator[Quantity]:  # noqa: ARG002
        """It stays on its arc."""
        yield from ()

    def unit_vectors(self) -> tuple[Array, ...]:
        """The orientation."""
        return (self.orientation,)

    def start_error(self) -> float:
        """It starts where it is."""
        return 0.0

    def end_error(self) -> float:
        """It stays where it is."""
        return 0.0

    def own_checks(self) -> Iterator[Discrepancy]:
        """None."""
        yield from ()

    def stretched(self, factor: float, start_time: float) -> "Dwell":  # noqa: ARG002
        """The same rest, as long, from `start_time` [s]."""
        return replace(self, start_time=start_time)

    def document(self) -> dict[str, Any]:
        """As the law file has it."""
        return {
            "kind": self.kind,
            "at": self.at,
            "start_time": self.start_time,
            "duration": self.duration,
            "orientation": self.orientation.tolist(),
            **({} if self.point is None else {"point": self.point.tolist()}),
        }

    @classmethod
    def read(cls, s: DwellDocument) -> "Dwell":
        """From the law file; numbers are taken bit for bit."""
        point = None if s.point is None else np.array(s.point, dtype=float)
        return cls(s.at, s.start_time, s.duration, np.array(s.orientation, dtype=float), point)
