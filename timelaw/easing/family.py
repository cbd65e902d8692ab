"""Families of easings, as the problem file names them: which basis a leg gets, and where a search starts."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Protocol

import numpy as np

from timelaw.easing import smoothstep
from timelaw.easing.breaks import divide_breaks, merge_breaks
from timelaw.easing.double_s_easing import classify_profile, cut_double_s, fit_double_s
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.easing.spline_basis import SplineBasis
from timelaw.easing.timing import Timing
from timelaw.least_time.constant_bounds import choose_bounds
from timelaw.limits import Demand

Basis = PolynomialBasis | SplineBasis

SHORTEST_PHASE = 2e-5  # of the run: in control points of the whole easing the jerk of shorter ones drowns
RESOLUTION = 3e-6  # relative rounding of a rate that an interval may cost
SIZED = (1, 2, 3)  # orders of the rates by which a spline is scaled
PROFILE_DEGREE = 3  # of the double-S profile, which is C2 inside


class Family(Protocol):
    """A family knows the continuity at the ends of a leg, and gives bases and starts run by run."""

    @property
    def continuity(self) -> int:
        """Number of derivatives that are continuous at the nodes."""
        ...

    @property
    def label(self) -> str:
        """How reports call it."""
        ...

    def bases(self, demands: Sequence[Demand]) -> tuple[Basis, ...]:
        """One basis per leg of a run."""
        ...

    def closed_form(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """The best law in closed form over a run, within its limits and as smooth as the family."""
        ...

    def start(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """Where the search for the best law over a run starts."""
        ...

    @property
    def inside(self) -> int:
        """The class C^k of its easings inside a leg, at most 4."""
        ...

    @property
    def rigid(self) -> bool:
        """Whether the closed form is all there is: nothing is left to choose."""
        ...

    def simpler(self) -> "Family | None":
        """A family whose laws this one contains, of about half the freedom; None if there is none."""
        ...

    def contains(self, degree: int) -> bool:
        """Whether every polynomial of that degree on a leg is one of its easings."""
        ...

    def has_profile(self, demands: Sequence[Demand]) -> bool:
        """Whether the double-S profile over a run counts as one of its laws."""
        ...

    @property
    def polynomials(self) -> PolynomialBasis | None:
        """The basis that all legs have, if it is the same one polynomial."""
        ...


@dataclass(frozen=True)
class PolynomialFamily:
    """One polynomial of `degree` on every leg."""

    degree: int
    continuity: int
    inside: ClassVar[int] = 4
    rigid: ClassVar[bool] = False

    @property
    def label(self) -> str:
        """Degree."""
        return f"polynomial of degree {self.degree}"

    def bases(self, demands: Sequence[Demand]) -> tuple[Basis, ...]:
        """The same for all legs."""
        return (PolynomialBasis(self.degree, self.continuity),) * len(demands)

    def closed_form(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """The smoothstep over the run, which the basis contains."""
        return smoothstep.time_run(demands, self.continuity)

    start = closed_form

    def simpler(self) -> Family | None:
        """A polynomial of about half the freedom; none for the least."""
        least = 2 * self.continuity + 1
        degree = (self.degree + least) // 2
        return PolynomialFamily(degree, self.continuity) if least + 2 <= degree < self.degree else None

    def contains(self, degree: int) -> bool:
        """Up to its own."""
        return degree <= self.degree

    def has_profile(self, demands: Sequence[Demand]) -> bool:  # noqa: ARG002
        """Its laws have one piece a leg."""
        return False

    @property
    def polynomials(self) -> PolynomialBasis | None:
        """Whatever is demanded."""
        return PolynomialBasis(self.degree, self.continuity)


@dataclass(frozen=True)
class SplineFamily:
    """Splines of `degree` on some `intervals` per leg, placed on the phases of the double-S profile."""

    degree: int
    intervals: int
    continuity: int
    rigid: ClassVar[bool] = False

    @property
    def inside(self) -> int:
        """Splines are as smooth at their breaks as their degree allows."""
        return min(self.degree - 1, 4)

    @property
    def label(self) -> str:
        """Degree and intervals."""
        return f"spline of degree {self.degree} on {self.intervals} intervals"

    def bases(self, demands: Sequence[Demand]) -> tuple[Basis, ...]:
        """Breaks from the profile over the run, cut at its nodes."""
        angles = [demand.angle for demand in demands]
        timings = cut_double_s(angles, *choose_bounds(demands), SHORTEST_PHASE)
        peaks = [_peak(angles, timings, order) for order in SIZED]
        return tuple(
            self._basis(
                timing, [peak * timing.duration**k / angle for k, peak in zip(SIZED, peaks, strict=True)]
            )
            for timing, angle in zip(timings, angles, strict=True)
        )

    def _basis(self, timing: Timing, peaks: Sequence[float]) -> SplineBasis:
        """On the phases of a leg, `peaks` being the largest rates of the run as derivatives of its easing.

        A leg that is a tiny part of the run has but little of the run's jerk to resolve: fewer intervals.
        """
        first, second, third = (peak or 1.0 for peak in peaks)
        least = (50 * np.finfo(float).eps / RESOLUTION / third) ** (1 / 3)
        least = max(least, (8 * np.finfo(float).eps / RESOLUTION / second) ** (1 / 2))
        breaks = merge_breaks(timing.easing.breaks.tolist(), least)
        if self.continuity > 3:
            fourth = third / float(np.min(np.diff(breaks)))
            least = max(least, (400 * np.finfo(float).eps / RESOLUTION / fourth) ** (1 / 4))
        divided = divide_breaks(breaks, self.intervals, least)
        fewest = max(1, 2 * (self.continuity + 1) - self.degree)  # of fewer, the ends take all coefficients
        if len(divided) <= fewest:
            divided = tuple(np.linspace(0.0, 1.0, fewest + 1).tolist())
        return SplineBasis(self.degree, divided, self.continuity, (first, second, third))

    def closed_form(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """The double-S profile, a spline of degree 3; for smoother ones the smoothstep."""
        slow = smoothstep.time_run(demands, self.continuity)
        if not self.has_profile(demands):
            return slow
        return min(slow, self.start(demands), key=lambda timings: sum(t.duration for t in timings))

    def start(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """The double-S profile, which smoother splines come near to."""
        return fit_double_s(demands)

    def simpler(self) -> Family | None:
        """None: a spline on fewer intervals is no simpler to find."""
        return None

    def contains(self, degree: int) -> bool:
        """Up to its own."""
        return degree <= self.degree

    def has_profile(self, demands: Sequence[Demand]) -> bool:
        """Of degree 3, where it is as smooth as they are."""
        return self.degree <= PROFILE_DEGREE and classify_profile(demands) >= self.continuity

    @property
    def polynomials(self) -> PolynomialBasis | None:
        """None: the breaks are those of the leg's own profile."""
        return None


@dataclass(frozen=True)
class DoubleSFamily:
    """The double-S profile itself: nothing is left to choose."""

    continuity: int
    inside: ClassVar[int] = 2
    rigid: ClassVar[bool] = True

    @property
    def label(self) -> str:
        """Its name."""
        return "double-S profile"

    def bases(self, demands: Sequence[Demand]) -> tuple[Basis, ...]:
        """Splines of degree 3 on its phases, for what asks for a basis."""
        return SplineFamily(PROFILE_DEGREE, 1, min(self.continuity, 2)).bases(demands)

    def closed_form(self, demands: Sequence[Demand]) -> tuple[Timing, ...]:
        """The profile over the run."""
        return fit_double_s(demands)

    start = closed_form

    def simpler(self) -> Family | None:
        """There is one profile."""
        return None

    def contains(self, degree: int) -> bool:  # noqa: ARG002
        """It is none."""
        return False

    def has_profile(self, demands: Sequence[Demand]) -> bool:  # noqa: ARG002
        """Nothing else."""
        return True

    @property
    def polynomials(self) -> PolynomialBasis | None:
        """None: it is in pieces."""
        return None


def _peak(angles: Sequence[float], timings: Sequence[Timing], order: int) -> float:
    """The largest rate [rad/s^k] over all legs of a run."""
    return max(
        rate.size
        for angle, timing in zip(angles, timings, strict=True)
        for rate in timing.rates(angle, order)
    )
