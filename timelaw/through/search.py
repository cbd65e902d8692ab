"""Sequential cone programming: better step by step, at any moment with a curve that holds the limits."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from timelaw.interrupts import check_interrupted
from timelaw.numerics.array import Array
from timelaw.through.columns import Columns
from timelaw.through.cone_step import Aim, Step, solve_step
from timelaw.through.curve import Curve
from timelaw.through.measures import SAMPLES, Measure, Use
from timelaw.through.rows import Rows, collect_rows

MOST_STEPS = 100
FIRST_RADIUS, LARGEST_RADIUS, LEAST_RADIUS = 0.3, 1.0, 1e-6  # of the trust region, in what counts as one
GOOD, POOR = 0.7, 0.25  # of the fall that was predicted: the region grows, or shrinks
FALLEN, PREDICTED = 2e-5, 8e-5  # of the merit: twice less, and the search is over
CALM = 2  # so many small steps in a row end the search
WORTH, PATIENCE = 1e-4, 8  # of the least merit: less won in so many steps, and the search is over
TINY = 1e-300


@dataclass(frozen=True)
class Found:
    """A curve that holds the limits on a grid, if there is one, the last one tried, and how it was found."""

    curve: Curve | None
    last: Curve
    steps: int
    rows: int


@dataclass(frozen=True)
class Look:
    """What is seen of a curve: what it uses, and its merit, which is made less."""

    use: Use
    merit: float


class Plan(Protocol):
    """What is made least, and what may be done to a curve."""

    def look(self, curve: Curve, samples: int) -> Look:
        """At a curve."""
        ...

    def hold(self, curve: Curve) -> Sequence[Measure]:
        """What is held down in a step from a curve."""
        ...

    def sample(self, curve: Curve, measures: Sequence[Measure], samples: int) -> Array:
        """The used parts (p, m, L) by which rows are chosen."""
        ...

    def aim(self, curve: Curve, columns: Columns, rows: Rows) -> Aim:
        """What a step makes less."""
        ...

    def predict(self, curve: Curve, tried: Curve, step: Step, columns: Columns) -> float:
        """The merit that a step promises, all rows held."""
        ...

    def allows(self, look: Look, before: Look) -> bool:
        """Whether a step may lead there."""
        ...

    def keep(self, best: Curve | None, curve: Curve, look: Look) -> Curve | None:
        """The better of two that hold the limits."""
        ...

    def rescue(self, curve: Curve, look: Look) -> Curve | None:
        """A curve to go on from where no step was found; None to end."""
        ...

    def finish(self, best: Curve) -> Curve:
        """The best curve, looked at once more."""
        ...


def improve(
    curve: Curve,
    columns: Columns,
    angles: Array,
    plan: Plan,
    *,
    radius: float = FIRST_RADIUS,
    samples: int = SAMPLES,
    is_over: Callable[[], bool] = lambda: False,
    until_held: bool = False,
) -> Found:
    """The best curve found, never worse than the one it begins with if that holds the limits.

    Any that holds them is good enough if it is looked for `until_held`.
    """
    calm, most, steps = 0, 0, 0
    look = plan.look(curve, samples)
    best = plan.keep(None, curve, look)
    least, idle = look.merit, 0
    while steps < MOST_STEPS and not (until_held and best is not None):
        steps += 1
        check_interrupted()
        measures = plan.hold(curve)
        rows = collect_rows(curve, columns, measures, plan.sample(curve, measures, samples), radius)
        most = max(most, len(rows.power))
        scales = columns.scales(curve, angles)
        step = solve_step(curve, columns, rows, scales, radius, plan.aim(curve, columns, rows))
        if step is None:  # too far beyond the limits for so small a step
            rescued = plan.rescue(curve, look)
            radius *= 2
            if rescued is None or radius > 4 * LARGEST_RADIUS:
                break
            curve, look = rescued, plan.look(rescued, samples)
            continue
        tried = columns.move(curve, step.change)
        seen = plan.look(tried, samples)
        fall = (look.merit - seen.merit) / look.merit
        hoped = (look.merit - plan.predict(curve, tried, step, columns)) / look.merit
        if fall > 0 and plan.allows(seen, look):
            curve, look = tried, seen
            best = plan.keep(best, curve, look)
            radius = _resize(radius, fall / max(hoped, TINY))
            calm = calm + 1 if fall < FALLEN and hoped < PREDICTED else 0
            idle += best is not None  # else what is asked for is still not held
            if look.merit < least * (1 - WORTH):
                least, idle = look.merit, 0
            if calm == CALM or idle == PATIENCE:
                break
        elif hoped < FALLEN or radius < LEAST_RADIUS or is_over():
            break
        else:
            radius /= 3
        if is_over():
            break
    return Found(None if best is None else plan.finish(best), curve, steps, most)


def _resize(radius: float, ratio: float) -> float:
    if ratio > GOOD:
        return min(2 * radius, LARGEST_RADIUS)
    return radius / 2 if ratio < POOR else radius
