"""What the search holds down: each limit as a vector in the rates over a bound, leg by leg.

A limit of power k is V(X, h H)/(b h^k), X the rates in a piece's own time h: its used part is the size of
that to the power 1/k, the factor by which time would have to be stretched if H, the total angular momentum,
is zero. Of power 0 is what time does not change.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from timelaw.limits import LIMITS, Bounds, Limit, make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.formula import ZERO, Vector
from timelaw.numerics.array import Array
from timelaw.through.curve import Curve
from timelaw.through.dual import stack
from timelaw.through.kinematics import States, list_rates, make_basis, turn_back

Mask = NDArray[np.bool_]
SLOWEST, HALVINGS = 9.0, 40  # of a stretch: its logarithm at most, and how often the range is halved
LEEWAY = 5e-4  # beyond what is asked where slowness mends nothing; what is asked keeps as far away
SAMPLES = 61  # places of a piece at which the search looks; what is proved is proved afterwards


class Measure(Protocol):
    """One thing that is held down: `bounds` (K, 1) on the norm or (K, 3) by axis, infinite where none."""

    @property
    def bounds(self) -> Array: ...  # noqa: D102
    @property
    def power(self) -> int: ...  # noqa: D102
    @property
    def highest(self) -> int:
        """The order of the highest derivative of Q that enters."""
        ...

    @property
    def stretches(self) -> bool:
        """Whether in c times the time its used part is 1/c of what it was."""
        ...

    def vector(self, q: States, rates: Mapping[int, Vector], h: Any, legs: Any) -> Vector:
        """V (3) at states of Q in the time of pieces h, which are of the `legs` (their numbers)."""
        ...


@dataclass(frozen=True)
class LimitMeasure:
    """A limit of the registry; `bounds` are those of the legs."""

    limit: Limit
    bounds: Array
    total: Vector

    @property
    def power(self) -> int:
        """Of time."""
        return self.limit.power

    @property
    def highest(self) -> int:
        """As of its rate."""
        return self.limit.highest

    @property
    def stretches(self) -> bool:
        """But for a total momentum."""
        return not any(self.total)

    def vector(self, q: States, rates: Mapping[int, Vector], h: Any, legs: Any) -> Vector:  # noqa: ARG002
        """The limit's own formula; H h in the time of pieces."""
        if not any(self.total):
            return self.limit.vector(rates, ZERO)
        return self.limit.vector(rates, [part * h for part in turn_back(q[0], self.total)])

    def use_rates(self, q: Array, rates: Array, leg: int) -> float:
        """The part of its bound on a leg that rates (r, 3) at an orientation use; 0 if they do not say it."""
        if self.highest > len(rates):
            return 0.0
        total = turn_back(list(q), self.total) if any(self.total) else ZERO
        vector = np.array(self.limit.vector(dict(enumerate(rates, 1)), total), dtype=float)
        bounds = self.bounds[leg]
        size = np.max(np.abs(vector) / bounds) if len(bounds) == 3 else np.linalg.norm(vector) / bounds[0]
        return float(size)


@dataclass(frozen=True)
class Scaled:
    """Another measure under `factor` times its bounds, for all legs or each (K, 1)."""

    measure: Measure
    factor: float | Array

    @property
    def bounds(self) -> Array:
        """Those of the other, scaled."""
        return self.measure.bounds * self.factor

    @property
    def power(self) -> int:
        """As of the other."""
        return self.measure.power

    @property
    def highest(self) -> int:
        """As of the other."""
        return self.measure.highest

    @property
    def stretches(self) -> bool:
        """As of the other."""
        return self.measure.stretches

    def vector(self, q: States, rates: Mapping[int, Vector], h: Any, legs: Any) -> Vector:
        """As of the other."""
        return self.measure.vector(q, rates, h, legs)


def list_limit_measures(
    limits: Mapping[str, Bounds],
    own: Sequence[Mapping[str, Bounds]],
    body: RigidBody | None = None,
    total: Vector = ZERO,
) -> list[LimitMeasure]:
    """Those of all legs, and of each leg its own (K): one for each limit and form of it.

    `total` is the angular momentum H in world axes.
    """
    found = []
    for name in dict.fromkeys([*limits, *(name for leg in own for name in leg)]):
        for width in (1, 3):
            bounds = np.full((len(own), width), np.inf)
            for k, leg in enumerate(own):
                for given in (limits.get(name), leg.get(name)):
                    if given is not None and np.size(given) == width:
                        bounds[k] = np.minimum(bounds[k], given)
            if np.any(np.isfinite(bounds)):
                any_bound: Bounds = (1.0, 1.0, 1.0) if width == 3 else 1.0
                (limit,) = make_limits({name: any_bound}, body)
                found.append(LimitMeasure(limit, bounds, total if LIMITS[name].needs_inertia else ZERO))
    return found


def find_highest(measures: Sequence[Measure]) -> int:
    """The order of the highest derivative of Q that any of them needs."""
    return max([1, *(measure.highest for measure in measures)])


def sample_used(
    curve: Curve, measures: Sequence[Measure], samples: int = SAMPLES, *, plain: bool = False
) -> Array:
    """The used parts (p, m, L) on a grid; `plain`: by their size, and not by the stretch that mends them."""
    basis = make_basis(curve.degree, np.linspace(0.0, 1.0, samples), find_highest(measures))
    states = np.einsum("mko,poc->kcpm", basis, curve.control())
    rates = list_rates(states)
    legs = np.repeat(np.arange(len(curve.duration)), curve.pieces)[:, None]
    steps = curve.steps[:, None]
    found = []
    for measure in measures:
        bounds = measure.bounds[legs[:, 0], None]

        def use(slower: Array, measure: Measure = measure, bounds: Array = bounds) -> Array:
            step = steps * slower
            return find_used(measure, measure.vector(states, rates, step, legs), bounds, step)

        simple = plain or measure.stretches
        found.append(use(np.ones(1)) if simple else _find_stretch(use, (len(steps), samples)))
    return np.stack(np.broadcast_arrays(*found), axis=-1)


def _find_stretch(use: Callable[[Array], Array], shape: tuple[int, int]) -> Array:
    """By bisection the factors (p, m) by which time has to be stretched to be within."""
    low, high = np.full(shape, -SLOWEST), np.full(shape, SLOWEST)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        within = use(np.exp(middle)) <= 1
        low, high = np.where(within, low, middle), np.where(within, middle, high)
    return np.asarray(np.exp(high))


def find_used(measure: Measure, vector: Vector, bounds: Array, steps: Array) -> Array:
    """The used part (...) of a vector of components (...), bounds (..., 1) or (..., 3)."""
    value = np.abs(stack(list(vector)))
    size = (
        np.max(value / bounds, axis=-1)
        if bounds.shape[-1] == 3
        else np.linalg.norm(value, axis=-1) / bounds[..., 0]
    )
    power = measure.power
    return np.asarray((size / steps**power) ** (1 / power) if power else size)


@dataclass(frozen=True)
class Use:
    """By which factor (K,) each leg by itself should be slower, and what slowness does not mend (K,)."""

    stretch: Array
    fixed: Array

    @property
    def worst(self) -> float:
        """The largest stretch that is needed."""
        return float(np.max(self.stretch))

    @property
    def broken(self) -> bool:
        """Whether anything is beyond its bound."""
        return self.worst > 1 or bool(np.max(self.fixed) > 1)

    @property
    def excess(self) -> float:
        """How far what slowness does not mend is beyond its bounds."""
        return float(max(np.max(self.fixed) - 1 - LEEWAY, 0.0))


def find_tops(used: Array) -> tuple[Array, Array]:
    """Of used parts (p, m, L) on a grid, at each place the top of the parabola through it and its neighbours.

    Where it is within half a step: where that is, in steps from the place, and how high.
    """
    shift, top = np.zeros((2, *used.shape))
    left, middle, right = used[:, :-2], used[:, 1:-1], used[:, 2:]
    bend = 2 * middle - left - right
    slope = (right - left) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        step = slope / bend
    near = (bend > 0) & (np.abs(step) <= 0.5)
    shift[:, 1:-1] = np.where(near, step, 0.0)
    top[:, 1:-1] = np.where(near, slope * shift[:, 1:-1] / 2, 0.0)
    return shift, used + top


def find_use(
    curve: Curve, measures: Sequence[Measure], samples: int = SAMPLES, *, plain: bool = False
) -> Use:
    """On a grid, and `plain` as in `sample_used`."""
    _, used = find_tops(sample_used(curve, measures, samples, plain=plain))
    mends = np.array([m.power > 0 for m in measures])
    parts = [
        np.max(used[:, :, mask].reshape(len(curve.duration), -1), axis=1, initial=0.0)
        for mask in (mends, ~mends)
    ]
    return Use(*parts)
