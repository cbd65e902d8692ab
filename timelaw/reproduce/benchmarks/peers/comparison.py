"""The part `peers`: all of them on two routes."""

from collections.abc import Iterator

import numpy as np

from timelaw.reproduce.benchmarks.machine import find_version
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.peers import drake_peer, own, ruckig_peer, scipy_peer, toppra_peer
from timelaw.reproduce.benchmarks.peers.judge import Verdict, judge_motion
from timelaw.reproduce.benchmarks.peers.motion import Course, Peer
from timelaw.reproduce.benchmarks.problems import LIMITS, align_signs, lay_out_data, make_lattice_data
from timelaw.reproduce.benchmarks.stopwatch import time_call
from timelaw.reproduce.benchmarks.table import MISSING, Table, format_ratio, format_spread
from timelaw.requirements.route_limit import find_route_limit

PEERS: tuple[Peer, ...] = (
    *own.PEERS,
    *ruckig_peer.PEERS,
    *drake_peer.PEERS,
    *toppra_peer.PEERS,
    *scipy_peer.PEERS,
)
NAMES = {11: "24-cell, 11 legs", 59: "600-cell, 59 legs"}
ORDERS = ("ω", "α", "jerk")
HEADINGS = (
    "design",
    "route",
    "total time [s]",
    "to the limit of the arcs",
    "worst violation",
    "nodes at rest",
    "off the arcs",
    "CPU [ms]",
    "to degree 9",
)
SEEN = 1e-4  # of a limit; what differences on the fine grid tell
REPEATS = {True: 3, False: 7}  # by quick
NOTES = (
    "**To the limit of the arcs**: the total time over that of the double-S along the arcs, straight "
    "nodes passed, which no motion along the arcs can be faster than; one that leaves the arcs can. "
    "**Worst violation**: of |ω|, |α|, |jerk|, by differences of the orientations alone on 5000 points a "
    "leg, which share no code with any of the designers; “none”: less than 1e-4.",
    "**CPU**: median (least–most) of the design alone from the route on, all in one process, equal legs "
    "solved once by everyone, evaluation not included.",
)


def measure(*, quick: bool) -> Table:
    """Every peer on the routes."""
    rows = [row for legs in NAMES for row in _list_rows(legs, REPEATS[quick])]
    setups = tuple(f"**{peer.label}**{_tell_version(peer)}: {peer.setup}." for peer in PEERS)
    return Table(HEADINGS, tuple(map(tuple, rows)), (*NOTES, *setups))


def _list_rows(legs: int, repeats: int) -> Iterator[list[str]]:
    layout = lay_out_data(make_lattice_data(legs))
    nodes = align_signs(np.array([layout.route.legs[0].start, *(leg.end for leg in layout.route.legs)]))
    limits = np.radians(list(LIMITS.values())).tolist()
    course = Course(NAMES[legs], nodes, (limits[0], limits[1], limits[2]))
    least = find_route_limit(layout.route, layout.requirements)
    reference: list[float] = []
    for peer in PEERS:
        if find_version(peer.package) is None and peer.package != "timelaw":
            yield [peer.label, course.name, MISSING, *[""] * (len(HEADINGS) - 3)]
            continue
        design = peer.prepare(course)
        verdict = judge_motion(design(), course)
        spent = time_call(design, repeats)
        reference = reference or spent
        yield [
            peer.label,
            course.name,
            f"{verdict.duration:.3f}",
            f"{verdict.duration / least:.4f}",
            tell_violation(verdict),
            f"{verdict.resting} of {len(nodes)}",
            f"{np.degrees(verdict.deviation):.1f}°" if verdict.deviation > SEEN else "0",
            format_spread(spent, 1e-3),
            format_ratio(spent, reference),
        ]


def tell_violation(verdict: Verdict) -> str:
    """How far the limit that is broken most is broken; a rate that jumps makes the next one infinite."""
    if verdict.jumping is not None:
        return f"{ORDERS[verdict.jumping - 1]} jumps, {ORDERS[verdict.jumping]} unbounded"
    order = int(np.argmax(verdict.used))
    over = verdict.used[order] - 1
    return f"{ORDERS[order]} by {100 * over:.2g} %" if over > SEEN else "none"


def _tell_version(peer: Peer) -> str:
    found = find_version(peer.package)
    return f" ({peer.package} {found})" if found and peer.package != "timelaw" else ""


PART = Part("peers", HEADINGS, measure)
