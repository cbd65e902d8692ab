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
from timelaw.through.given import MARGIN
from timelaw.through.given_route import GivenRoute, decide, describe_lack, find_given_passage, find_place
from timelaw.through.passage import Passage, Through
from timelaw.time_law import TimeLaw
from timelaw.time_law.time_law import OPTIMISED_LAW

ROUNDS = 8  # of stretching; one is enough but where a total momentum makes a limit not homogeneous
MARGINS = (MARGIN, 10 * MARGIN)  # of the limits, by which the search keeps from them
ASIDE = 1e-12  # of the time: how far a law keeps from its limits


def prove_passages(
    problem: Problem, route: Route, requirements: Requirements, through: Through, timings: Sequence[Timing]
) -> tuple[Through, QuaternionLaw, Certificate]:
    """The law of all passages, each curve run through as fast as what is proved of it allows.

    A curve that then is no faster than stopping, or leaves its arcs too far, is given up.
    """
    passages = list(through.passages)
    name, continuity = problem.name, problem.nodes.continuity
    for _ in range(ROUNDS):
        law = compose_through(
            name,
            route,
            passages,
            timings,
            requirements,
            continuity,
            problem.motion.deviation,
            periodic=problem.nodes.periodic,
        )
        certificate = certify(law)
        factors = find_factors(certificate, law, passages)
        if all(factor is not None and 1 - 3 * ASIDE < factor <= 1 for factor in factors):
            break
        passages = [
            passage.take(None if factor is None or passage.curve is None else passage.curve.stretched(factor))
            for passage, factor in zip(passages, factors, strict=True)
        ]
    return replace(through, passages=tuple(passages)), law, certificate


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
    given: GivenRoute,
    timings: Sequence[Timing] | None,
    time: float,
    progress: Progress | None = None,
) -> tuple[Through, QuaternionLaw, Certificate]:
    """The law that keeps what is given: a curve, or the `timings` of one that stops, where that is better.

    `time` [s] is what a law takes that stops. A curve that is not proved is searched again farther from the
    limits.

    Raises:
        InfeasibleError: there is no law that keeps it.
    """

    def tell(rung: int, rungs: int) -> None:
        if progress is not None:
            progress("passing the nodes", rung, rungs)

    for margin in MARGINS:
        passage = find_given_passage(given, time, tell, margin)
        through = decide(problem, requirements, given, passage, timings)
        if through.passages[0].curve is None:
            break
        law = compose_through(
            problem.name,
            route,
            through.passages,
            (),
            requirements,
            problem.nodes.continuity,
            problem.motion.deviation,
            periodic=problem.nodes.periodic,
        )
        certificate = certify(law)
        if certificate.limits_hold or margin == MARGINS[-1]:
            return through, law, certificate
    if timings is None:
        raise InfeasibleError(Fault(describe_lack(passage), find_place(problem, requirements, route)))
    law = compose_law(
        problem.name,
        route,
        TimeLaw(OPTIMISED_LAW, tuple(timings), requirements.dwells),
        requirements,
        problem.nodes.continuity,
    )
    return through, law, certify(law)
