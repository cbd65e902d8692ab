"""What segments that move the body have in common: from node to node, in pieces that fill their time."""

from collections.abc import Iterable, Mapping
from math import fsum
from typing import Annotated, Any, ClassVar

from pydantic import Field

from timelaw.easing.profile import Side
from timelaw.limits import Bounds
from timelaw.limits.bounds import write_bounds
from timelaw.motion.schema import BoundsDocument, Duration, Number, Part, Text, Vector4
from timelaw.motion.segment import Discrepancy
from timelaw.numerics.array import Array

DURATION_TOLERANCE = 1e-12  # of the segment; durations of pieces are rounded each


class LegDocument(Part):
    """What a law file says of every segment that moves the body."""

    origin: Annotated[Text, Field(alias="from")]
    target: Annotated[Text, Field(alias="to")]
    start_time: Number
    duration: Duration
    start: Vector4
    end: Vector4
    limits: BoundsDocument = Field(default_factory=dict)


class Moving:
    """A leg from `origin` to `target`, orientations `start` to `end` (4,), with limits of its own."""

    kind: ClassVar[str]
    origin: str
    target: str
    start_time: float
    duration: float
    start: Array
    end: Array
    limits: Mapping[str, Bounds]

    @property
    def travels(self) -> bool:
        """Whether it says where the body's origin is."""
        return False

    def place(self, tau: Array, order: int, side: Side) -> Array:  # noqa: ARG002
        """Where the origin is; a body that only turns has it nowhere."""
        raise ValueError("the motion has no translation")

    @property
    def name(self) -> str:
        """How reports call the segment."""
        return f"{self.origin}–{self.target}"

    @property
    def end_time(self) -> float:
        """Instant [s] at which the segment ends."""
        return self.start_time + self.duration

    def check_filled(self, durations: Iterable[float]) -> Discrepancy:
        """How far the durations of pieces are from adding up, exact before it is rounded."""
        error = abs(fsum([*durations, -self.duration])) / self.duration
        return Discrepancy("pieces take their segment's time", error, DURATION_TOLERANCE)

    def write(self, geometry: dict[str, Any], pieces: list[dict[str, Any]]) -> dict[str, Any]:
        """As the law file has it: what all have, what is this kind's own, limits, pieces."""
        own = {"limits": write_bounds(self.limits)} if self.limits else {}
        return {
            "kind": self.kind,
            "from": self.origin,
            "to": self.target,
            "start_time": self.start_time,
            "duration": self.duration,
            "start": self.start.tolist(),
            "end": self.end.tolist(),
            **geometry,
            **own,
            "pieces": pieces,
        }
