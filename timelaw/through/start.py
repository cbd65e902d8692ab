"""Where the search begins: a clamped spline through the nodes, as slow as the limits ask for."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import multiply
from timelaw.through.curve import Curve, make_curve
from timelaw.through.dual import stack
from timelaw.through.kinematics import list_rates
from timelaw.through.measures import Measure, find_use

SPLINE_DEGREES = {2: 3, 3: 5}  # by class: the spline's is one more than what its knots' rates need
ROUNDS = 12  # of evening out the legs
SPREAD = 0.35  # the power of what a leg uses against the one that uses most


def begin(
    turn: Array,
    rests: Sequence[int],
    duration: Array,
    degree: int,
    measures: Sequence[Measure],
    *,
    smooth: int = 2,
    periodic: bool = False,
) -> Curve:
    """A curve of one piece a leg through nodes (n, 4) of alike signs, within the limits.

    At rest at both ends, unless it is `periodic`, and at the nodes `rests`; `duration` (n-1,) is about
    what legs take.
    """
    rates = read_rates(turn, duration, rests, smooth, periodic=periodic)
    return settle(make_curve(degree, 1, turn, rates, duration), measures)


def read_rates(
    turn: Array,
    duration: Array,
    rests: Sequence[int],
    smooth: int,
    *,
    periodic: bool = False,
    ends: tuple[Array | None, Array | None] = (None, None),
) -> Array:
    """Rates (n, r, 3) at the nodes of a spline; at its ends as given (r, 3), or rest, or going round."""
    if periodic and not rests:
        return _read_periodic(turn, duration, smooth)
    return _read_spline(turn, duration, sorted({0, *rests, len(turn) - 1}), smooth, ends)


def settle(curve: Curve, measures: Sequence[Measure]) -> Curve:
    """The curve as slow as it must be, its legs evened out."""
    use = find_use(curve, measures)
    best = curve.stretched(use.worst)
    for _ in range(ROUNDS):
        curve = _even_out(curve, use.stretch)
        use = find_use(curve, measures)
        if curve.total * use.worst < best.total:
            best = curve.stretched(use.worst)
    return best


def _even_out(curve: Curve, stretch: Array) -> Curve:
    """Legs that use less faster, the rates of knots with them."""
    factor = (stretch / np.max(stretch)) ** SPREAD
    meet = np.repeat(factor, curve.pieces)
    at = np.sqrt(np.append(meet[-1], meet) * np.append(meet, meet[0]))  # of a tour that goes round too
    powers = np.arange(1, curve.smooth + 1)[:, None]
    return make_curve(
        curve.degree,
        curve.pieces,
        curve.turn,
        curve.rates / at[:, None, None] ** powers,
        curve.duration * factor,
    )


def _read_spline(
    turn: Array,
    duration: Array,
    rests: Sequence[int],
    smooth: int,
    ends: tuple[Array | None, Array | None] = (None, None),
) -> Array:
    """Rates (n, r, 3) at the nodes of the spline in R⁴ that is at rest where it should be."""
    from scipy.interpolate import make_interp_spline  # takes long to load; most motions stop

    times = np.concatenate([[0.0], np.cumsum(duration)])
    degree = SPLINE_DEGREES[smooth]
    rates = np.zeros((len(turn), smooth, 3))
    for end, given in zip((0, -1), ends, strict=True):
        if given is not None:
            rates[end] = given
    for first, last in pairwise(rests):
        own = slice(first, last + 1)
        edges: Any = [
            [(k, _derive(turn[end], rates[end], k)) for k in range(1, (degree + 1) // 2)]
            for end in (first, last)
        ]
        spline = make_interp_spline(times[own], turn[own], k=degree, bc_type=tuple(edges))
        inner = slice(first + 1, last)
        states = [list(spline(times[inner], k).T) for k in range(smooth + 1)]
        for k, vector in list_rates(states).items():
            rates[inner, k - 1] = stack(list(vector))
    return rates


def _derive(q: Array, rates: Array, order: int) -> Array:
    """Q' or Q'' at a knot, of constant norm."""
    omega, alpha = rates[:2]
    state = np.append(0.0, omega / 2) if order == 1 else np.append(-omega @ omega / 4, alpha / 2)
    return multiply(q, state)


def _read_periodic(turn: Array, duration: Array, smooth: int) -> Array:
    """Rates (n, r, 3) of a tour that goes round: three rounds, of which the middle one is read."""
    legs = len(duration)
    sign = 1.0 if float(turn[0] @ turn[-1]) > 0 else -1.0
    round_ = turn[:-1]
    laps = np.concatenate([round_ * sign, round_, round_ * sign, round_[:1]])
    rates = _read_spline(laps, np.tile(duration, 3), [0, 3 * legs], smooth)
    own = rates[legs : 2 * legs + 1]
    own[-1] = own[0]
    return own
