"""Alterations of what a law says of its path: how far it may leave its arcs, whether it goes round."""

from collections.abc import Callable
from math import nextafter, pi
from random import Random
from typing import Any

from tests.exact.alterations import STEPS
from tests.exact.curve_alterations import choose_curve
from tests.exact.way_alterations import WAY_ALTERATIONS, travels

Document = dict[str, Any]


def is_path(document: Document) -> bool:
    """Whether the origin moves, or how far the body leaves its arcs is limited, or the motion goes round."""
    curves = [segment for segment in document["segments"] if segment["kind"] == "rational"]
    limited = any("deviation" in segment.get("limits", {}) for segment in curves)
    return travels(document) or limited or bool(document.get("periodic"))


def alter_path(rng: Random, document: Document) -> str:
    """One of the alterations that only such laws can have."""
    own = WAY_ALTERATIONS if travels(document) and rng.random() < 0.8 else PATH_ALTERATIONS
    return rng.choice(own)(rng, document)


def limit_deviation(rng: Random, document: Document) -> str:
    """The bound on a deviation at what is reached, lower, or anything; or one where there was none."""
    limits = choose_curve(rng, document).setdefault("limits", {})
    given = limits.get("deviation")
    by = rng.choice((1e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-9, 1e-6, 1e-3, 0.5))
    if given is None or rng.random() < 0.3:
        limits["deviation"] = rng.choice((10 ** rng.uniform(-9, 0), pi, nextafter(pi, 0), 3.0))
        return "another deviation"
    limits["deviation"] = given * (1 - by)
    return f"deviation less {by:g} of it"


def bend_end(rng: Random, document: Document) -> str:
    """An end of a segment elsewhere, with the points that touch it: the arc is another one."""
    segment, step = choose_curve(rng, document), rng.choice((*STEPS, 0.1))
    key, index = rng.choice((("start", 0), ("end", -1)))
    segment[key] = [x + rng.uniform(-step, step) for x in segment[key]]
    size = sum(x * x for x in segment[key]) ** 0.5
    segment[key] = [x / size for x in segment[key]]
    segment["pieces"][index]["control"][index] = list(segment[key])
    return f"an end and its point moved by {step:g}"


def go_round(rng: Random, document: Document) -> str:
    """Round instead of from rest to rest, or the other way; with rates outside, or not."""
    if document.get("periodic") and rng.random() < 0.7:
        del document["periodic"]
    else:
        document["periodic"] = True
    if rng.random() < 0.1:
        document["outside"] = {"before": {"omega": [0.0, 0.0, 0.0]}}
    return "periodic the other way"


def open_round(rng: Random, document: Document) -> str:
    """The last end a little aside, or turned around with all of its segment."""
    segment = document["segments"][-1]
    if "pieces" not in segment or rng.random() < 0.2:
        return go_round(rng, document)
    step = rng.choice(STEPS)
    if rng.random() < 0.3:
        for piece in segment["pieces"]:
            piece["control"] = [[-x for x in point] for point in piece["control"]]
        segment["start"], segment["end"] = ([-x for x in segment[key]] for key in ("start", "end"))
        return "the last segment turned around"
    for point in (segment["end"], segment["pieces"][-1]["control"][-1]):
        point[0] += step
    return f"the round opened by {step:g}"


PATH_ALTERATIONS: tuple[Callable[[Random, Document], str], ...] = (
    go_round,
    open_round,
    bend_end,
    *[limit_deviation] * 3,
)
