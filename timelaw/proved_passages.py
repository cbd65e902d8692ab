"""Curves through the nodes as they are proved: slower by the exact factor, or a little faster."""

from collections.abc import Sequence
from dataclasses import replace

from timelaw.certificate import Certificate, certify
from timelaw.certificate.limit_check import LegPeak
from timelaw.compose import compose_law, compose_through
from timelaw.easing import Timing
from timelaw.errors import Fault, InfeasibleError
from timelaw.limits import LIMITS, make_limits
from timelaw.motion import QuaternionLaw
from timelaw.motion.deviation import DEVIATION
from timelaw.problem import Problem
from timelaw.progress import Progress
from timelaw.requirements import Requirements
from timelaw.route import Route
from timelaw.through.curve import Curve
from timelaw.through.given import MARGIN
from timelaw.through.given_route import (
    GivenRoute,
    decide,
    describe_lack,
    find_given_passage,
    find_place,
    spend_stopping,
)
from timelaw.through.passage import Passage, Through
from timelaw.time_law import TimeLaw
from timelaw.time_law.time_law import OPTIMISED_LAW
from timelaw.time_limit import is_late

ROUNDS = 8  # of stretching; one is enough but where a total momentum makes a limit not homogeneous
MARGINS = (MARGIN, 10 * MARGIN)  # of the limits, by which the search keeps from them
ASIDE = 1e-12  # of the time: how far a law keeps from its limits
ROUNDING = 4e-16  # of a factor, whose peaks were rounded up


def prove_passages(
    problem: Problem, route: Route, requirements: Requirements, through: Through, timings: Sequence[Timing]
) -> tuple[Through, QuaternionLaw, Certificate]:
    """The law of all passages, each curve run through as fast as what is proved of it allows.

    A curve that then is no faster than stopping, leaves its arcs too far, or has rates that rounding makes
    jump, is given up.
    """
    passages = list(through.passages)
    for number in range(ROUNDS + 1):
        law = _lay(problem, route, requirements, passages, timings)
        certificate = certify(law)
        factors = find_factors(certificate, law, passages)
        if certificate.continuity.order < problem.nodes.continuity:
            factors = [1.0 if passage.curve is None else None for passage in passages]
        if all(factor is not None and 1 - 3 * ASIDE < factor <= 1 + ROUNDING for factor in factors):
            break
        given_up = number == ROUNDS - 1
        passages = [
            passage.take(_pace(passage.curve, factor, given_up=given_up))
            for passage, factor in zip(passages, factors, strict=True)
        ]
    return replace(through, passages=tuple(passages)), law, certificate


def _pace(curve: Curve | None, factor: float | None, *, given_up: bool) -> Curve | None:
    """A curve in `factor` times the time; none where time mends nothing, or rounds enough did not."""
    if curve is None or factor is None or (given_up and factor > 1 + ROUNDING):
        return None
    return curve.stretched(factor)


def _lay(
    problem: Problem,
    route: Route,
    requirements: Requirements,
    passages: Sequence[Passage],
    timings: Sequence[Timing],
) -> QuaternionLaw:
    """The law of passages."""
    return compose_through(
        problem.name,
        route,
        passages,
        timings,
        requirements,
        problem.nodes.continuity,
        problem.motion.deviation,
        periodic=problem.nodes.periodic,
    )


def find_factors(
    certificate: Certificate, law: QuaternionLaw, passages: Sequence[Passage]
) -> list[float | None]:
    """By how much each passage has to be slower, or may be faster; None where time mends nothing.

    1 for passages without a curve.
    """
    powers = {limit.name: limit.power for limit in make_limits(_list_limits(law), law.body)}
    of_leg = [k for k, passage in enumerate(passages) for _ in passage.legs]
    legs = iter(of_leg)
    of_segment = {index: next(legs) for index, segment in enumerate(law.segments) if segment.moves}
    used = [0.0] * len(passages)
    broken = [False] * len(passages)
    for peak in certificate.peaks:
        passage = of_segment[peak.index]
        if peak.row.limit == DEVIATION:
            broken[passage] |= peak.used > 1
        else:
            used[passage] = max(used[passage], _find_factor(peak, law, powers[peak.row.limit]))
    return [
        1.0 if passage.curve is None else None if lost else part * (1 + ASIDE)
        for passage, part, lost in zip(passages, used, broken, strict=True)
    ]


def _find_factor(peak: LegPeak, law: QuaternionLaw, power: int) -> float:
    """By how much slower one limit on one leg asks it to be, or lets it be faster.

    With a total momentum H: |H - Jω/c| ≤ |H| + (|H - Jω| - |H|)/c, and of a torque only the part that falls
    with 1/c is counted on; nothing is made faster.
    """
    total = law.body.total_momentum if law.body is not None else 0.0
    if not (total and LIMITS[peak.row.limit].needs_inertia):
        return float(peak.used ** (1 / power))
    if peak.used <= 1:
        return 1.0 - 2 * ASIDE
    if power > 1 or peak.bound <= total:
        return peak.used
    return (peak.upper - total) / (peak.bound - total)


def _list_limits(law: QuaternionLaw) -> dict[str, float]:
    """Every limit that is there, whatever its bounds."""
    names = {*law.limits, *(name for segment in law.segments for name in segment.limits)} - {DEVIATION}
    return dict.fromkeys(names, 1.0)


def prove_given(
    problem: Problem,
    route: Route,
    requirements: Requirements,
    given: GivenRoute | None,
    timings: Sequence[Timing] | None,
    time: float,
    progress: Progress | None = None,
) -> tuple[Through, QuaternionLaw, Certificate]:
    """The law that keeps what is given: a curve, or the `timings` of one that stops, where that is better.

    `time` [s] is what a law takes that stops. A curve that is not proved is searched again farther from the
    limits, and given up if that does not help. Where nothing is `given` there is no curve.

    Raises:
        InfeasibleError: there is no law that keeps it.
    """

    def tell(rung: int, rungs: int) -> None:
        if progress is not None:
            progress("passing the nodes", rung, rungs)

    passage = Passage(0, len(route.legs), time)
    for margin in MARGINS:
        if given is None:
            break
        passage = find_given_passage(given, time, tell, margin)
        through = decide(problem, requirements, given, passage, timings)
        if through.passages[0].curve is None:
            break
        law = _lay(problem, route, requirements, through.passages, ())
        certificate = certify(law)
        if certificate.limits_hold and certificate.continuity.order >= problem.nodes.continuity:
            return through, law, certificate
    if timings is None:
        raise InfeasibleError(Fault(describe_lack(passage), find_place(problem, requirements, route)))
    time_law = TimeLaw(OPTIMISED_LAW, tuple(timings), requirements.dwells)
    law = compose_law(problem.name, route, time_law, requirements, problem.nodes.continuity)
    spent = spend_stopping(problem, requirements, timings)
    return Through((replace(passage, curve=None),), is_late(), spent, spent), law, certify(law)
