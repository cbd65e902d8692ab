"""A motion through the nodes where times, rates at its ends or another objective than time are given.

The whole route is one curve, at rest where it has to be. First the largest used part of the limits is made
less until they hold, then the goal; both by the search that stretches nothing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf

import numpy as np

from timelaw.numerics.array import Array
from timelaw.through.columns import number_columns
from timelaw.through.curve import Curve, make_curve
from timelaw.through.effort import measure_effort
from timelaw.through.given_times import GivenTimes, Goal, fit_durations
from timelaw.through.ladder import ENOUGH, SPLIT_RADIUS, Form, Rung, Stretch
from timelaw.through.leaving import limit_deviation
from timelaw.through.measures import SAMPLES, LimitMeasure, Measure, Scaled, find_use, sample_used
from timelaw.through.more_pieces import split
from timelaw.through.search import Found, improve
from timelaw.through.start import read_rates
from timelaw.time_limit import is_late

MARGIN = 1e-4  # of the limits, by which the search keeps from them: nothing can be stretched afterwards
PRICES = (3.0, 30.0, 300.0)  # of breaking limits, until none is broken
CALM_PART = 1e-4  # of jerk against time, where given times leave room: of equally fast laws a calm one


@dataclass(frozen=True)
class Given:
    """What is given besides the limits: rates (r, 3) at both ends, None for rest; legs of `fixed` durations.

    `budgets` are (legs from the first on, their time [s]). `time` and `effort` weigh the goal, or `peak` is
    it; `vector` is what is squared in the effort, E₀ and T₀ its `scales`, None for those of the start.
    """

    vector: LimitMeasure
    start: Array | None = None
    end: Array | None = None
    fixed: Mapping[int, float] = field(default_factory=dict)
    budgets: Sequence[tuple[int, float]] = ()
    time: float = 0.0
    effort: float = 1.0
    peak: bool = False
    scales: tuple[float, float] | None = None


def climb_given(
    stretch: Stretch,
    measures: Sequence[Measure],
    form: Form,
    given: Given,
    first: Curve | None = None,
    margin: float = MARGIN,
    tell: Callable[[int, int], None] = lambda _, __: None,
) -> tuple[Curve | None, list[Rung]]:
    """The best curve of the rungs that holds what is given; None if none was found.

    `first` is a curve that keeps the given times already. `margin` is how far the search keeps from limits.
    """
    limits = list(measures)
    if form.deviation is not None:
        limits.append(limit_deviation(stretch.turn, form.deviation))
    curve = first or begin_given(stretch, form, given)
    held = [Scaled(m, _tighten(m, curve, given, margin)) for m in limits]
    if given.scales is None:
        given = replace(given, scales=(curve.total, measure_effort(curve, given.vector)))
    best: Curve | None = None
    value, told = inf, []
    for number, (degree, pieces) in enumerate(form.rungs):
        tell(number, len(form.rungs))
        if number and is_late():
            break
        if curve.pieces != pieces:
            curve = split(curve, pieces)
        found, reached = _search_given(curve, stretch, limits, held, given)
        told.append(Rung(degree, pieces, found.curve.total if found.curve else 0.0, found.steps, found.rows))
        gain = 1.0 if best is None else (value - reached) / abs(value)
        if found.curve is not None and reached < value:
            best, value = found.curve, reached
        if form.pieces is None and best is not None and gain < ENOUGH:
            break
        curve = found.curve or found.last
    return best, told


def _tighten(measure: Measure, curve: Curve, given: Given, margin: float) -> Array:
    """The factor (K, 1) of its bounds; next to none on a leg that begins or ends at the limit itself."""
    factors = np.full((len(curve.duration), 1), 1 - margin * max(measure.power, 1))
    used = sample_used(curve, [measure], 2, plain=True)
    for rates, leg, place in ((given.start, 0, 0), (given.end, -1, -1)):
        if rates is not None and used[leg, place, 0] > 1 - 2 * margin:
            factors[leg] = 1.0
    return factors


def begin_given(stretch: Stretch, form: Form, given: Given) -> Curve:
    """A curve that keeps all that is given but the limits."""
    duration = fit_durations(stretch.durations, given.fixed, given.budgets)
    rates = read_rates(
        stretch.turn,
        duration,
        stretch.rests,
        form.smooth,
        periodic=stretch.periodic,
        ends=(given.start, given.end),
    )
    return make_curve(form.rungs[0][0], 1, stretch.turn, rates, duration)


def _search_given(
    curve: Curve,
    stretch: Stretch,
    limits: Sequence[Measure],
    measures: Sequence[Measure],
    given: Given,
) -> tuple[Found, float]:
    """The curve that is best for the goal, and how good; first one that holds the limits at all."""
    columns = number_columns(curve, stretch.held, periodic=stretch.periodic, fixed=tuple(given.fixed))
    scales = given.scales or (1.0, 1.0)
    goal = Goal(given.time, given.effort, scales, given.vector, tuple(given.budgets), given.peak)
    steps, radius = 0, SPLIT_RADIUS
    use = find_use(curve, measures, plain=True)
    if use.worst > 1 or use.excess or given.peak:
        plan = GivenTimes(replace(goal, peak=True), limits, measures, columns)
        found = improve(curve, columns, stretch.angles, plan, radius=radius, is_over=is_late)
        steps, curve = found.steps, found.curve or found.last
        if given.peak or found.curve is None:
            value = plan.look(curve, SAMPLES).merit if found.curve is not None else inf
            return found, value
    for price in PRICES:
        plan = GivenTimes(goal, limits, measures, columns, price)
        found = improve(curve, columns, stretch.angles, plan, radius=radius, is_over=is_late)
        if found.curve is not None:
            break
    value = inf if found.curve is None else plan.look(found.curve, SAMPLES).merit
    return replace(found, steps=found.steps + steps), value
