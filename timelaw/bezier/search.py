"""The least time of a run by cone programs in a trust region, each with all limits to first order.

A rate depends at an instant on u, u', u'', … alone, and these are linear in the easing's coefficients: what
is not linear is how the curve bends, and the time. A step makes Σ T least under the limits at points and at
their present maxima, u' ≥ 0, and a bound on each variable; it is taken if the time is less once it is
stretched until all limits hold. What is kept holds them at all points; the proof comes after, on the law.
"""

from dataclasses import dataclass, replace

import numpy as np

from timelaw.bezier.cone_step import move, solve_step
from timelaw.bezier.legs import Choice, Leg, Run, begin
from timelaw.bezier.rates import STATES, measure_parts
from timelaw.errors import Fault, InfeasibleError
from timelaw.numerics.array import Array
from timelaw.time_limit import is_late

FIRST_RADIUS, FINER_RADIUS, LARGEST_RADIUS, LEAST_RADIUS = 0.1, 1e-3, 1.0, 1e-7
STEPS, ROUNDS = 150, 4
SETTLED = 1e-7  # relative change of the time by points that are added
TOP = 0.99  # of a limit: maxima above it are looked at more closely
GOOD, POOR = 0.7, 0.1  # of the gain that a step promised
TINY = 1e-300  # used part of a limit that is none
ENOUGH = 1e-7  # relative gain below which a step is the last
INSIDE = 1e-9  # relative; the search's own stretch, before anything is proved
BACKWARD = -1e-9  # of the mean u'; what rounding makes of a stop
HALVINGS = 60


@dataclass(frozen=True)
class Found:
    """What was found on a run, in how many steps, with how many rows at most; `begun` is the start's time."""

    run: Run
    choice: Choice
    steps: int
    rows: int
    stopped: bool
    begun: float


def find_fastest(run: Run, where: str) -> Found:
    """The fastest easings on a run that were found from smoothsteps; limits hold at all its points.

    Raises:
        InfeasibleError: no time is long enough, or nothing bounds the time of a curve.
    """
    choice = settle(run, begin(run), where)
    found = Found(run, choice, 0, 0, False, choice.total)
    for index in range(ROUNDS):
        before = found.choice.total
        found = _improve(found, FINER_RADIUS if index else FIRST_RADIUS)
        finer = _refine(found.run, found.choice)
        found = replace(found, run=finer, choice=found.choice.stretched(find_stretch(finer, found.choice)))
        if found.stopped or abs(found.choice.total / before - 1) < SETTLED:
            break
    return found


def _improve(found: Found, radius: float) -> Found:
    """The search on the points of a run, from a trust region."""
    run, choice, most = found.run, found.choice, found.rows
    for count in range(found.steps + 1, found.steps + STEPS + 1):
        if is_late():
            return replace(found, choice=choice, steps=count - 1, rows=most, stopped=True)
        step, rows = solve_step(run, choice, radius)
        most = max(most, rows)
        promised = gained = 0.0
        if step is not None:
            promised = -float(np.sum(step[: len(run.legs)])) / choice.total
            if promised < ENOUGH:
                break
            trial, gained = _try(run, choice, step)
        if gained > POOR * promised:
            choice = trial
            radius = min(2 * radius, LARGEST_RADIUS) if gained > GOOD * promised else radius
        else:
            radius /= 3
            if radius < LEAST_RADIUS:
                break
    return replace(found, choice=choice, steps=count, rows=most)


def _try(run: Run, choice: Choice, step: Array) -> tuple[Choice, float]:
    """The choice after a step, within the limits at all points, and what part of the time it gains."""
    trial = move(run, choice, step)
    if trial is None or not _goes_forward(run, trial):
        return choice, 0.0
    trial = trial.stretched(find_stretch(run, trial))
    return trial, 1 - trial.total / choice.total


def _refine(run: Run, choice: Choice) -> Run:
    """The run with points added where limits are nearly at their largest, between those that it has."""
    legs = []
    for k, leg in enumerate(run.legs):
        tau, used = leg.tau, choice.used(run, k)
        low, middle, high = used[:, :-2], used[:, 1:-1], used[:, 2:]
        limit, top = np.nonzero((middle >= low) & (middle >= high) & (middle > TOP))
        a, b, c = (tau[top + i] for i in range(3))
        d, e = (b - a) * (middle - high)[limit, top], (c - b) * (middle - low)[limit, top]
        with np.errstate(divide="ignore", invalid="ignore"):
            vertex = b - 0.5 * ((b - a) * d - (c - b) * e) / (d + e)  # of the parabola through three points
        inside = vertex[(vertex > a) & (vertex < c)]
        legs.append(replace(leg, tau=np.unique(np.concatenate([tau, inside]))))
    return replace(run, legs=tuple(legs))


def find_stretch(run: Run, choice: Choice) -> float:
    """The factor of time at which the first limit is reached at a point of the run."""
    if any(np.any(leg.total) for leg in run.legs):
        return _find_root(run, choice) * (1 + INSIDE)
    largest = 0.0
    for k, leg in enumerate(run.legs):
        powers = np.array([split.limit.power for split in leg.limits])
        largest = max(largest, float(np.max(np.max(choice.used(run, k), axis=1) ** (1 / powers))))
    return largest * (1 + INSIDE)


def _find_root(run: Run, choice: Choice) -> float:
    """The same where the momentum of wheels is part of what is limited, which time does not divide."""

    def excess(factor: float) -> float:
        """What is used of the limits beyond all of them."""
        slow = choice.stretched(factor)
        return max(float(np.max(slow.used(run, k))) for k in range(len(run.legs))) - 1

    low = high = 1.0
    for _ in range(HALVINGS):
        if excess(high) <= 0:
            break
        high *= 2
    else:
        return float("inf")
    for _ in range(HALVINGS):
        if excess(low) > 0:
            break
        low /= 2
    else:
        return low
    if low == high:
        return high
    from scipy.optimize import brentq

    return float(brentq(excess, low, high, xtol=low * INSIDE / 4, rtol=INSIDE / 4))


def settle(run: Run, choice: Choice, where: str) -> Choice:
    """The start, which stops at every node, with each leg in its least time."""
    durations = []
    for k, leg in enumerate(run.legs):
        if not _is_limited(leg, choice.states(run, k)):
            message = f"nothing that is limited moves on curve {leg.curve.name}: no time is the least"
            raise InfeasibleError(Fault(message, where))
        alone = Choice(choice.durations[k : k + 1], choice.free[k : k + 1], choice.rates[:0])
        factor = find_stretch(Run((leg,), ()), alone)
        if not 0 < factor < np.inf:
            raise InfeasibleError(Fault(f"no time is long enough for curve {leg.curve.name}", where))
        durations.append(alone.total * factor)
    return replace(choice, durations=np.array(durations))


def _is_limited(leg: Leg, states: Array) -> bool:
    """Whether what moves on a leg is limited."""
    rest = states * (np.arange(STATES) == 0)
    moving, still = (measure_parts(leg.curve, leg.limits, s, leg.total) for s in (states, rest))
    return bool(np.any(np.abs(moving - still) > TINY))


def _goes_forward(run: Run, choice: Choice) -> bool:
    return all(
        float(np.min(choice.states(run, k)[:, 1])) * choice.durations[k] >= BACKWARD
        for k in range(len(run.legs))
    )
