"""From few numbers to many: one piece a leg, then more, until the next rung gains too little."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from timelaw.numerics.array import Array
from timelaw.through.columns import number_columns
from timelaw.through.curve import Curve
from timelaw.through.least_time import LeastTime
from timelaw.through.leaving import limit_deviation
from timelaw.through.measures import LimitMeasure, Measure, find_use
from timelaw.through.more_pieces import split
from timelaw.through.rounding import TOLERABLE, find_blur
from timelaw.through.search import FIRST_RADIUS, Found, improve
from timelaw.through.start import begin, settle
from timelaw.time_limit import is_late

AUTO_PIECES = 2  # at most, where none are asked for
AUTO_DEGREES = {2: 6, 3: 8}  # by class C^r: the first whose inner points are free
ENOUGH = 3e-3  # of the time: a rung that gains less is the last one
SPLIT_RADIUS = 0.1  # of the trust region after a split
SPLIT_LOSS = 1.2  # times the time: a split that loses more is done from the first rung's curve
TINY = 0.2  # of the mean angle of legs: where some are smaller, both ways to measure rates are tried
MANY = 300  # legs: of more of them one way is tried only, for each takes minutes
NARROWER = 0.5  # by which a bound on the deviation is lowered, from one that is reached to the one asked for
MOST_BOUNDS = 12


@dataclass(frozen=True)
class Rung:
    """What one rung came to: its time [s], 0 for no law, and steps of the search."""

    degree: int
    pieces: int
    time: float
    steps: int
    rows: int


@dataclass(frozen=True)
class Stretch:
    """The nodes (K+1, 4) of a stretch, signs alike, its legs' angles (K,), and about how long they take."""

    turn: Array
    angles: Array
    durations: Array
    rests: tuple[int, ...] = ()
    periodic: bool = False

    @property
    def held(self) -> NDArray[np.bool_]:
        """At which nodes the rates are given: at `rests`, and at both ends unless it goes round."""
        ends = np.zeros(len(self.turn), dtype=bool)
        ends[list(self.rests)] = True
        if not self.periodic:
            ends[[0, -1]] = True
        return ends


@dataclass(frozen=True)
class Form:
    """Degree and pieces, None for a search; the class C^r, and the bound on leaving the arcs [rad]."""

    smooth: int
    degree: int | None = None
    pieces: int | None = None
    deviation: float | None = None

    @property
    def searched(self) -> bool:
        """Whether degree and pieces are both left open."""
        return self.degree is None and self.pieces is None

    @property
    def rungs(self) -> list[tuple[int, int]]:
        """(degree, pieces), from the poorest on."""
        degree = self.degree or AUTO_DEGREES[self.smooth]
        return [(degree, p) for p in range(1, (self.pieces or AUTO_PIECES) + 1)]


def climb(
    stretch: Stretch,
    limits: Sequence[LimitMeasure],
    form: Form,
    tell: Callable[[int, int], None] = lambda _, __: None,
) -> tuple[Curve | None, list[Rung]]:
    """The fastest curve of the rungs, and what each came to; None if none holds what is asked.

    Where pieces are asked for, every rung up to them is climbed. A rung whose pieces are so short that
    rounding would make the rates jump counts for none.
    """
    best: Curve | None = None
    free: list[Curve] = []  # what was found of each rung without a bound on the deviation
    told: list[Rung] = []
    for number, (degree, pieces) in enumerate(form.rungs):
        tell(number, len(form.rungs))
        if number and is_late():
            break
        first = _begin_rung(stretch, limits, form, degree, pieces, free)
        found = _search(first, stretch, limits, FIRST_RADIUS if pieces == 1 else SPLIT_RADIUS)
        free.append(found.curve or found.last)
        steps = found.steps
        if form.deviation is not None:
            found = _keep_near(free[-1], stretch, limits, form.deviation, best)
            steps += found.steps
        blurred = found.curve is not None and find_blur(found.curve, limits) > TOLERABLE
        time = found.curve.total if found.curve and not blurred else 0.0
        told.append(Rung(degree, pieces, time, steps, found.rows))
        gain = 1.0 if best is None else 1 - time / best.total if time else 0.0
        if found.curve is not None and gain > 0 and not blurred:
            best = found.curve
        if form.pieces is None and gain < ENOUGH:
            break
    return best, told


def _begin_rung(
    stretch: Stretch, limits: Sequence[Measure], form: Form, degree: int, pieces: int, free: Sequence[Curve]
) -> Curve:
    if not free:
        own = (stretch.turn, stretch.rests, stretch.durations, degree, limits)
        return begin(*own, smooth=form.smooth, periodic=stretch.periodic)
    for source in (free[-1], free[0]):
        parted = split(source, pieces)
        first = parted.stretched(find_use(parted, limits).worst)
        if first.total < SPLIT_LOSS * source.total:
            return first
    return settle(parted, limits)


def _search(
    curve: Curve,
    stretch: Stretch,
    measures: Sequence[Measure],
    radius: float,
    *,
    until_held: bool = False,
) -> Found:
    """The better of what both ways to measure the rates at nodes come to, where there are tiny legs."""
    small = float(np.min(stretch.angles)) < TINY * float(np.mean(stretch.angles))
    tiny = small and len(stretch.angles) <= MANY
    found: list[Found] = []
    for clocks in (False, True) if tiny else (False,):
        one = improve(
            curve,
            number_columns(curve, stretch.held, periodic=stretch.periodic, clocks=clocks),
            stretch.angles,
            LeastTime(measures),
            radius=radius,
            is_over=is_late,
            until_held=until_held,
        )
        found.append(one)
        if until_held and one.curve is not None:
            break
    return min(found, key=lambda one: one.curve.total if one.curve else np.inf)


def _keep_near(
    curve: Curve, stretch: Stretch, limits: Sequence[Measure], bound: float, known: Curve | None
) -> Found:
    """From a curve that leaves the arcs farther and from one of fewer pieces that is near, the better.

    Where neither comes to anything, bound by bound; only the last one counts.
    """

    def search(begun: Curve, angle: float) -> Found:
        near = [*limits, limit_deviation(stretch.turn, angle)]
        return _search(begun, stretch, near, FIRST_RADIUS, until_held=angle > bound)

    found = search(curve, bound)
    if known is not None:
        parted = split(known, curve.pieces)
        near = search(parted.stretched(find_use(parted, limits).worst), bound)
        return min((found, near), key=lambda one: one.curve.total if one.curve else np.inf)
    for angle in () if found.curve is not None else _list_bounds(curve, stretch.turn, bound):
        if is_late():
            break
        found = search(curve, angle)
        curve = found.curve or found.last
    return found


def _list_bounds(curve: Curve, turn: Array, bound: float) -> Iterator[float]:
    """Smaller and smaller ones, down to it."""
    far = 2 * np.arcsin(min(1.0, float(np.max(find_use(curve, [limit_deviation(turn, np.pi)]).fixed))))
    steps = min(MOST_BOUNDS, int(np.ceil(np.log(max(far / bound, 1.0)) / -np.log(NARROWER))))
    for k in range(1, steps):
        yield float(far * (bound / far) ** (k / steps))
    yield bound
