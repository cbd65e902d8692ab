"""timelaw itself, as it stands beside the others: the design and its proof, without reports and files."""

from functools import partial
from typing import Any

from timelaw.pipeline import Layout, design_layout
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion, Peer
from timelaw.reproduce.benchmarks.problems import POLYNOMIAL, SPLINE, lay_out_data, list_route, make_data

SETUP = (
    "stops at corners, goes on at straight nodes; the time is that of the design and of its proof for all "
    "t, from the route on, without report and files"
)


def _prepare(course: Course, **others: Any) -> partial[Motion]:
    return partial(_go, lay_out_data(make_data(list_route(course.nodes), **others)))


def _go(layout: Layout) -> Motion:
    law = design_layout(layout).optimised.law
    return Motion(law.times, law)


PEERS = (
    Peer("timelaw, degree 9", "timelaw", SETUP, partial(_prepare, easing=POLYNOMIAL)),
    Peer(
        "timelaw, degree 4 × 50",
        "timelaw",
        "the same by splines, jerk continuous inside",
        partial(_prepare, easing=SPLINE),
    ),
    Peer(
        "timelaw, double-S",
        "timelaw",
        "the same by the closed form",
        partial(_prepare, easing={"basis": "double-s"}),
    ),
    Peer(
        "timelaw, through",
        "timelaw",
        "past every node without a stop (`motion: through`), proved as well",
        partial(_prepare, motion="through"),
    ),
)
