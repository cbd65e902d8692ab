"""How far a motion leaves the arcs between its nodes, and where: proved, whether or not it is limited."""

from dataclasses import dataclass

from timelaw.motion import QuaternionLaw
from timelaw.numerics.function import enclose_peaks


@dataclass(frozen=True)
class Farthest:
    """An angle of the body [rad] that is reached at `time` [s] in `segment`, and one that never is."""

    angle: float
    upper: float
    time: float
    segment: str


def find_farthest(law: QuaternionLaw) -> Farthest | None:
    """Over all segments that may leave their arcs; None where none can."""
    places = [(segment, part) for segment in law.segments for part in segment.list_deviations()]
    if not places:
        return None
    tops = enclose_peaks([part.value for _, part in places])
    highest = max(range(len(tops)), key=lambda k: tops[k].lower)
    (segment, part), top = places[highest], tops[highest]
    tau = part.start + top.at * (part.end - part.start)
    size = part.row.size
    return Farthest(
        size(top.lower),
        max(size(one.upper) for one in tops),
        segment.start_time + segment.duration * tau,
        segment.name,
    )
