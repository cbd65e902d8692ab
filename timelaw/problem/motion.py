"""The part of a problem file about the motion: along the arcs, or past every node without a stop."""

from typing import Annotated, Any, Literal

from pydantic import Field

from timelaw.problem.fields import Model, fault, quantity, quote
from timelaw.units import ANGLE

MOTIONS = ("arcs", "through")
LEAST_DEVIATION, LARGEST_DEVIATION = 1e-4, 3.1  # rad; from half a turn on there is nothing to bound
LEAST_DEGREES = {1: 5, 2: 5, 3: 8}  # by continuity; the poorest of class C³ leave nothing to choose inside
LARGEST_DEGREE, MOST_PIECES = 9, 3


class Motion(Model):
    """How the body goes from node to node: `arcs` along the great circles, stopping where the axis turns.

    Or `through`: past every node without a stop, by rational segments of a `degree` in so many `pieces` a
    leg, `auto` or nothing for a search; `deviation` bounds how far the motion leaves the arcs.
    """

    kind: Literal["arcs", "through"] = "arcs"
    degree: Annotated[int, Field(ge=5, le=LARGEST_DEGREE)] | Literal["auto"] = "auto"
    pieces: Annotated[int, Field(ge=1, le=MOST_PIECES)] | Literal["auto"] = "auto"
    deviation: Annotated[float | None, quantity(ANGLE, LEAST_DEVIATION, LARGEST_DEVIATION)] = None

    @property
    def through(self) -> bool:
        """Whether nodes are passed without a stop."""
        return self.kind == "through"

    @property
    def chosen(self) -> tuple[int | None, int | None]:
        """Degree and pieces, None for what is searched."""
        return (
            None if self.degree == "auto" else self.degree,
            None if self.pieces == "auto" else self.pieces,
        )


def read_motion(value: Any) -> Any:
    """One word, or a mapping."""
    if isinstance(value, Motion):
        return value
    if isinstance(value, str) and value in MOTIONS:
        return {"kind": value}
    if not isinstance(value, dict):
        allowed = "arcs, through, or a mapping like {kind: through, deviation: 10 deg}"
        raise fault(f"{quote(value)}; allowed: {allowed}")
    others = [key for key in ("degree", "pieces", "deviation") if key in value]
    if others and value.get("kind") != "through":
        raise fault('it belongs to "kind: through"', others[0])
    return value
