"""Alterations of the parts of a law document: segments, pieces, limits and times that no longer fit."""

import copy
from collections.abc import Callable
from random import Random
from typing import Any

from tests.exact.curve_alterations import NUDGES, insert_curve_spike
from tests.exact.documents import dwell

Document = dict[str, Any]
LEGS = ("arc", "rational")


def _choose_leg(rng: Random, document: Document, kinds: tuple[str, ...] = LEGS) -> dict[str, Any]:
    return rng.choice([segment for segment in document["segments"] if segment["kind"] in kinds])


def _has_arcs(document: Document) -> bool:
    return any(segment["kind"] == "arc" for segment in document["segments"])


def _sum_starts(document: Document) -> None:
    """Make start times and the duration those of the segments."""
    time = 0.0
    for segment in document["segments"]:
        segment["start_time"] = time
        time += segment["duration"]
    document["duration"] = time


def delete_segment(rng: Random, document: Document) -> str:
    """One segment less."""
    del document["segments"][rng.randrange(len(document["segments"]))]
    return "a segment deleted"


def delete_segment_and_sum(rng: Random, document: Document) -> str:
    """One segment less, with times that add up."""
    delete_segment(rng, document)
    if document["segments"]:
        _sum_starts(document)
    return "a segment deleted, times summed"


def repeat_segment(rng: Random, document: Document) -> str:
    """One segment twice, with times that add up."""
    index = rng.randrange(len(document["segments"]))
    document["segments"].insert(index, copy.deepcopy(document["segments"][index]))
    _sum_starts(document)
    return "a segment repeated, times summed"


def swap_segments(rng: Random, document: Document) -> str:
    """Two neighbours in the other order, with times that add up."""
    segments = document["segments"]
    if len(segments) > 1:
        i = rng.randrange(len(segments) - 1)
        segments[i], segments[i + 1] = segments[i + 1], segments[i]
    _sum_starts(document)
    return "segments swapped, times summed"


def delete_piece(rng: Random, document: Document) -> str:
    """One piece less."""
    pieces = _choose_leg(rng, document)["pieces"]
    del pieces[rng.randrange(len(pieces))]
    return "a piece deleted"


def swap_pieces(rng: Random, document: Document) -> str:
    """A piece in another place, or repeated where there is one only."""
    pieces = _choose_leg(rng, document)["pieces"]
    pieces.insert(rng.randrange(len(pieces)), pieces[-1])
    if len(pieces) > 2:
        pieces.pop()
    return "pieces swapped"


def insert_spike(rng: Random, document: Document) -> str:
    """A short piece whose highest rate is large, after which the next one begins where it began before."""
    if not _has_arcs(document):
        return insert_curve_spike(rng, document)
    pieces = _choose_leg(rng, document, LEGS[:1])["pieces"]
    index = rng.randrange(len(pieces))
    spike = copy.deepcopy(pieces[index])
    spike["duration"] = 10 ** rng.uniform(-30, -10)
    spike["bernstein"] = [10 ** rng.uniform(0, 30) * rng.choice((-1, 1))]
    pieces.insert(index, spike)
    return "a spike inserted"


def insert_jump(rng: Random, document: Document) -> str:
    """A short piece in which one of the rates is another one."""
    if not _has_arcs(document):
        return insert_curve_spike(rng, document)
    pieces = _choose_leg(rng, document, LEGS[:1])["pieces"]
    index = rng.randrange(len(pieces))
    jump = copy.deepcopy(pieces[index])
    jump["duration"] = 10 ** rng.uniform(-30, -14)
    order = rng.randrange(len(jump["state"]))
    jump["state"][order] += 10 ** rng.uniform(-12, 2)
    pieces.insert(index, jump)
    return f"a jump of rate {order} inserted"


def shift_rest(rng: Random, document: Document) -> str:
    """All segments from one on a little later or earlier."""
    by = rng.choice((-1, 1)) * rng.choice(NUDGES)
    segments = document["segments"]
    for segment in segments[rng.randrange(len(segments)) :]:
        segment["start_time"] += by
    return f"later segments shifted by {by:g} s"


def insert_dwell(rng: Random, document: Document) -> str:
    """A dwell between two segments, with times that add up, or not at all."""
    segments = document["segments"]
    index = rng.randrange(len(segments))
    following = segments[index]
    at = following.get("from", following.get("at"))
    orientation = following.get("start", following.get("orientation"))
    duration = 10 ** rng.uniform(-9, 12)
    segments.insert(
        index, dwell(at, duration, start_time=following["start_time"], orientation=list(orientation))
    )
    if rng.random() < 0.5:
        _sum_starts(document)
        return "a dwell inserted, times summed"
    return "a dwell inserted"


def stretch_dwell(rng: Random, document: Document) -> str:
    """A dwell, or else an arc, that lasts longer than until the next segment."""
    dwells = [s for s in document["segments"] if s["kind"] == "dwell"] or document["segments"]
    factor = 10 ** rng.uniform(-15, 6)
    rng.choice(dwells)["duration"] *= 1 + factor
    return "a segment lasts longer"


def stretch_all(rng: Random, document: Document) -> str:
    """All durations a little shorter, with times that add up: the law is faster, its pieces are as before."""
    for segment in document["segments"]:
        segment["duration"] *= 1 - rng.choice(NUDGES[:-1])
    _sum_starts(document)
    return "durations shortened, times summed"


def scale_piece_time(rng: Random, document: Document) -> str:
    """A piece and its segment both shorter, with times that add up."""
    leg = _choose_leg(rng, document)
    piece = rng.choice(leg["pieces"])
    piece["duration"] *= 1 - rng.choice(NUDGES[:-1])
    leg["duration"] = sum(p["duration"] for p in leg["pieces"])
    _sum_starts(document)
    return "a piece shortened, times summed"


def raise_continuity(rng: Random, document: Document) -> str:
    """More asked for."""
    document["continuity"] = min(4, document.get("continuity", 0) + rng.randint(1, 2))
    return "continuity raised"


def add_own_limit(rng: Random, document: Document) -> str:
    """A limit of a segment of its own."""
    name = rng.choice(("velocity", "acceleration", "jerk", "snap"))
    value = 10 ** rng.uniform(-3, 5)
    _choose_leg(rng, document).setdefault("limits", {})[name] = value
    return f"an own limit on the {name}"


def add_limit(rng: Random, document: Document) -> str:
    """One more limit of the law."""
    name = rng.choice(("velocity", "acceleration", "jerk", "snap"))
    document["limits"][name] = 10 ** rng.uniform(-3, 5)
    return f"a limit on the {name} added"


def break_body(rng: Random, document: Document) -> str:
    """A body that cannot be, or is another one."""
    if "body" not in document:
        document["body"] = {"inertia": [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]}
    inertia = document["body"]["inertia"]
    i, j = rng.randrange(3), rng.randrange(3)
    inertia[i][j] += rng.choice((-30.0, 1e-6, 1e-9, 1e-8, 0.9, 30.0)) * inertia[0][0]
    if i != j and rng.random() < 0.7:
        inertia[j][i] = inertia[i][j]
        return "inertia altered, symmetric"
    return "inertia altered"


def move_outside(rng: Random, document: Document) -> str:
    """Other rates before or after the motion."""
    side = document.setdefault("outside", {}).setdefault(rng.choice(("before", "after")), {})
    rate = rng.choice(("omega", "alpha", "jerk"))
    side[rate] = [10 ** rng.uniform(-12, 0), 0.0, 0.0]
    return f"{rate} outside altered"


REARRANGEMENTS: tuple[Callable[[Random, Document], str], ...] = (
    delete_segment,
    delete_segment_and_sum,
    repeat_segment,
    swap_segments,
    delete_piece,
    swap_pieces,
    insert_spike,
    insert_jump,
    shift_rest,
    insert_dwell,
    stretch_dwell,
    stretch_all,
    scale_piece_time,
    raise_continuity,
    add_own_limit,
    add_limit,
    break_body,
    move_outside,
)
