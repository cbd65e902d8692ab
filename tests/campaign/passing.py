"""Motions through the nodes: problems that ask for them, and what is true of their laws."""

from collections.abc import Iterator

import numpy as np

from tests.campaign.attitude import apart
from tests.campaign.evidence import Evidence
from tests.campaign.spec import Spec, number

GRID = 401  # points of an arc, to the nearest of which the body's angle is measured
BESIDE = 1e-6  # rad
SLOWER = 1e-9  # relative


def ask_to_pass(rng, data: dict) -> dict:
    """The motion: mostly as it is found, now and then in a form or near the arcs."""
    least = 8 if data.get("nodes", {}).get("continuity", 2) == 3 else 5
    motion: dict = {"kind": "through"}
    if rng.random() < 0.3:
        motion["degree"] = int(rng.integers(least, 10))
    if rng.random() < 0.6:
        motion["pieces"] = int(rng.choice([1, 2, 3], p=[0.7, 0.2, 0.1]))
    if rng.random() < 0.25:
        motion["deviation"] = f"{float(10 ** rng.uniform(-0.5, 1.7)):.4g} deg"
    return motion


def find_bound(spec: Spec) -> float | None:
    """How far the body may leave its arcs [rad]."""
    motion = spec.data.get("motion", "arcs")
    return number(motion["deviation"]) if isinstance(motion, dict) and "deviation" in motion else None


def arcs_are_near(e: Evidence) -> Iterator[str]:
    """The body is never farther from the closed arc of its leg than is allowed."""
    bound = find_bound(e.spec)
    if bound is None:
        return
    for leg, (_, left), (arrived, _) in zip(e.legs, e.visits, e.visits[1:], strict=False):
        start, end = e.points[leg.origin], e.points[leg.target]
        signs = (1, -1) if abs(start @ end) < 1e-9 else (1 if start @ end >= 0 else -1,)  # of half-turns both
        there = np.asarray(e.law(np.linspace(left, arrived, 65)))
        nearest = min(_measure_way(there, start, sign * end) for sign in signs)
        aside = leg.angle / (GRID - 1) / 2  # at most, along the arc, to the nearest of its points
        if not nearest <= np.hypot(bound, aside) + BESIDE:
            yield f"leg {leg.origin}-{leg.target}: {nearest:.6g} rad from its arc, {bound:.6g} are allowed"


def _measure_way(there: np.ndarray, start: np.ndarray, end: np.ndarray) -> float:
    """The largest angle [rad] of the orientations (m, 4) to an arc."""
    half = np.arccos(np.clip(start @ end, -1, 1))
    s = np.linspace(0, 1, GRID)[:, None]
    arc = (np.sin((1 - s) * half) * start + np.sin(s * half) * end) / np.sin(half)
    return max(float(np.min(apart(arc, q))) for q in there)


def stopping_is_no_faster(e: Evidence) -> Iterator[str]:
    """Where time is made least, no law that stops and holds its limits takes less."""
    if e.spec.objective["minimise"] != "time" or e.spec.timed or e.spec.moving:
        return
    mine = float(e.law.times[-1])
    for other in e.design.baselines:
        smooth = other.certificate.continuity.order >= e.spec.continuity
        its = float(other.law.times[-1])
        if other.certificate.limits_hold and smooth and not mine <= its * (1 + SLOWER):
            yield f"slower than the {other.name}: {mine:.9g} s, {its:.9g} s"


def speed_allows_it(e: Evidence) -> Iterator[str]:
    """A norm of the velocity w: no motion over angles θ takes less than Σ θ/w."""
    w = e.spec.limits.get("velocity")
    if w is None or np.ndim(w):
        return
    rest = sum(left - arrived for arrived, left in e.visits)
    least = rest + sum(leg.angle for leg in e.legs) / float(w)
    mine = float(e.law.times[-1])
    if not mine >= least * (1 - 1e-9) - e.spec.precision * len(e.legs) / float(w):
        yield f"too fast: {mine:.12g} s, at the largest speed the way takes {least:.12g} s"


PASSING_CHECKS = (arcs_are_near, stopping_is_no_faster, speed_allows_it)
