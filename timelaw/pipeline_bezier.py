"""From a problem file with Bézier curves to a certified law: joints, runs, easings, composition, proof."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from pathlib import Path

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.bezier.joints import Joint, find_joints
from timelaw.bezier.legs import Choice, Leg, Passage, Run, begin, make_basis, split_runs
from timelaw.bezier.rates import split_limits
from timelaw.bezier.read import read_curves
from timelaw.bezier.search import Found, find_fastest, settle
from timelaw.certificate import certify
from timelaw.certificate.limit_check import find_leg_peaks
from timelaw.compose_bezier import Legwork, compose_curves
from timelaw.easing import Timing
from timelaw.easing.family import Basis
from timelaw.easing.polynomial_basis import PolynomialBasis
from timelaw.errors import Fault, InfeasibleError, InputError
from timelaw.limits import Bounds, make_limits
from timelaw.motion import QuaternionLaw
from timelaw.motion.rational_document import MOST_CONTROL, MOST_POINTS
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.numerics.threads import on_one_thread
from timelaw.pipeline import Certified, end_on_cycle
from timelaw.problem import Problem, Source
from timelaw.progress import Progress, tell
from timelaw.time_law.baselines import PAPER_CONTINUITY, QUINTIC
from timelaw.time_law.time_law import OPTIMISED_LAW

PASSED = (1, 2, 3)  # continuities for which a joint may be passed at speed
ROUNDS = 30  # of proof and stretch; one or two where time divides what is limited
ABOVE = 1 + 1e-12  # what rounding makes of a stretched law


@dataclass(frozen=True)
class RunOutcome:
    """How one run was solved: its legs, the time found on points, and what the proof added to it."""

    found: Found
    legs: tuple[str, ...]
    duration: float
    gap: float


@dataclass(frozen=True)
class BezierDesign:
    """All that came of a problem with curves: what the report shows and the files hold."""

    path: Path
    problem: Problem
    source: Source
    curves: tuple[Curve, ...]
    joints: tuple[Joint, ...]
    passed: tuple[bool, ...]
    basis: Basis
    timings: tuple[Timing, ...]
    runs: tuple[RunOutcome, ...]
    optimised: Certified
    baselines: tuple[Certified, ...]

    @property
    def laws(self) -> tuple[Certified, ...]:
        """The optimised law, then the baselines."""
        return (self.optimised, *self.baselines)

    @property
    def stopped_early(self) -> bool:
        """Whether the time was over before all was searched."""
        return any(run.found.stopped for run in self.runs)


def design_curves(
    path: Path, problem: Problem, source: Source, progress: Progress | None = None
) -> BezierDesign:
    """Design the law of a problem whose route is one of Bézier curves.

    Raises:
        InputError: curves do not meet, or their degrees are too high.
        InfeasibleError: no time is long enough.
    """
    with source.placed(), on_one_thread():
        curves = read_curves(problem)
        joints = find_joints(curves)
        basis, tau = make_basis(problem.easing, problem.nodes.continuity)
        _refuse_degree(curves, basis)
        legs = _make_legs(problem, curves, basis, tau)
        passages = [_pass(problem, joint) for joint in joints]
        runs = split_runs(legs, passages)
        found = []
        for index, run in enumerate(runs):
            tell(progress, "searching easings", index, len(runs))
            found.append(find_fastest(run, "limits"))
        tell(progress, "proving the laws")
        choices = [one.choice for one in found]
        law, proved = _prove(problem, runs, choices)
        outcomes = tuple(
            RunOutcome(
                one, tuple(leg.curve.name for leg in run.legs), new.total, new.total / one.choice.total - 1
            )
            for one, run, new in zip(found, runs, proved, strict=True)
        )
        timings = tuple(t for run, choice in zip(runs, proved, strict=True) for t in choice.timings(run))
        optimised = end_on_cycle(problem, Certified(OPTIMISED_LAW, law, certify(law)))
        baselines = [_make_quintic(problem, legs)] if QUINTIC in problem.baselines else []
    went = tuple(passage is not None for passage in passages)
    return BezierDesign(
        path,
        problem,
        source,
        curves,
        joints,
        went,
        basis,
        timings,
        outcomes,
        optimised,
        tuple(baselines),
    )


def _refuse_degree(curves: Sequence[Curve], basis: Basis) -> None:
    """Say of an easing that its composition with a curve has more control points than a law file holds."""
    for curve in curves:
        for control, most in ((curve.control, MOST_CONTROL), (curve.numerator, MOST_POINTS)):
            degree = 0 if control is None else len(control) - 1
            if degree * basis.degree + 1 > most:
                possible = (most - 1) // degree
                message = f"{basis.degree}; on curve {curve.name} at most {possible} is possible"
                raise InputError(Fault(message, "easing.degree"))


def _make_legs(problem: Problem, curves: Sequence[Curve], basis: Basis, tau: Array) -> list[Leg]:
    """Each curve with the limits that hold on it."""
    body, total = problem.rigid_body(), np.zeros(3)
    if body is not None:
        total = rotation_matrix(curves[0].orientation(np.zeros(1))[0]) @ body.momentum
    general = problem.limits.given()
    return [
        Leg(
            curve,
            basis,
            tau,
            (*split_limits(general, body), *split_limits(_own(problem, curve), body)),
            total,
        )
        for curve in curves
    ]


def _own(problem: Problem, curve: Curve) -> dict[str, Bounds]:
    """Limits of one curve alone."""
    rule = problem.segments.get(f"{curve.origin}-{curve.target}")
    return rule.limits.given() if rule and rule.limits else {}


def _dwell(problem: Problem, label: str) -> float:
    rule = problem.nodes.at.get(label)
    return problem.nodes.dwell if rule is None or rule.dwell is None else rule.dwell


def _pass(problem: Problem, joint: Joint) -> Passage | None:
    """How a joint is passed; None where the body stops: the path is not smooth enough, or a stop is asked."""
    r, rule = problem.nodes.continuity, problem.nodes.at.get(joint.label)
    stops = _dwell(problem, joint.label) > 0 or (rule is not None and rule.stop)
    if stops or r not in PASSED or len(joint.ratios) < r:
        return None
    return Passage(joint.ratios)


def _lay(problem: Problem, runs: Sequence[Run], choices: Sequence[Choice]) -> QuaternionLaw:
    """The law of what is chosen on each run."""
    r = runs[0].continuity
    works = []
    for run, choice in zip(runs, choices, strict=True):
        timings = choice.timings(run)
        for k, (leg, timing) in enumerate(zip(run.legs, timings, strict=True)):
            still = (0 if k else r, r if k == len(run.legs) - 1 else 0)
            works.append(Legwork(leg.curve, timing, r, still, _own(problem, leg.curve)))
    labels = [works[0].curve.origin, *(work.curve.target for work in works)]
    shape = problem.body.shape if problem.body else None
    asked = problem.nodes.continuity
    head = QuaternionLaw(problem.name, (), problem.limits.given(), problem.rigid_body(), asked, shape=shape)
    return compose_curves(head, works, [_dwell(problem, label) for label in labels])


def _prove(
    problem: Problem, runs: Sequence[Run], choices: Sequence[Choice]
) -> tuple[QuaternionLaw, list[Choice]]:
    """The law, each run stretched by what the proof found its limits to be exceeded by.

    Raises:
        InfeasibleError: no stretch was enough.
    """
    given = problem.limits.given() | {
        n: b for curve in runs for leg in curve.legs for n, b in _own(problem, leg.curve).items()
    }
    powers = {limit.name: limit.power for limit in make_limits(given, problem.rigid_body())}
    owner = list(accumulate((len(run.legs) for run in runs), initial=0))
    kept = list(choices)
    for _ in range(ROUNDS):
        law = _lay(problem, runs, kept)
        order = {id(leg): index for index, leg in enumerate(law.legs)}
        factors = [1.0] * len(runs)
        for peak in find_leg_peaks(law):
            leg = order.get(id(law.segments[peak.index]))
            if leg is not None and peak.used > 1:
                run = next(i for i in range(len(runs)) if owner[i] <= leg < owner[i + 1])
                factors[run] = max(factors[run], peak.used ** (1 / powers[peak.row.limit]) * ABOVE)
        if max(factors) == 1.0:
            return law, kept
        if not np.all(np.isfinite(factors)):
            break
        kept = [choice.stretched(factor) for choice, factor in zip(kept, factors, strict=True)]
    raise InfeasibleError(Fault("no stretch of time brings the law within its limits", "limits"))


def _make_quintic(problem: Problem, legs: Sequence[Leg]) -> Certified:
    """The quintic over each curve, in its least time, with a stop at every joint."""
    basis = PolynomialBasis(2 * PAPER_CONTINUITY + 1, PAPER_CONTINUITY)
    runs = [Run((replace(leg, basis=basis),), ()) for leg in legs]
    law, _ = _prove(problem, runs, [settle(run, begin(run), "limits") for run in runs])
    law = replace(law, continuity=0)
    return Certified(QUINTIC, law, certify(law))
