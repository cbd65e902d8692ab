"""What came of a design, in sentences: for the terminal and for the head of the report."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite

from timelaw.easing.double_s_easing import classify_profile
from timelaw.easing.time_scaling import used_fraction
from timelaw.least_time.constant_bounds import rate_bounds
from timelaw.least_time.phase_plane import has_coupling
from timelaw.nlp.solution import sum_durations
from timelaw.objectives import OBJECTIVES, Objective
from timelaw.objectives.effort import CALM
from timelaw.pipeline import Design
from timelaw.report.passing_text import describe_passing
from timelaw.report.summary import LawRow
from timelaw.requirements.given_times import list_budgets
from timelaw.time_law.baselines import DOUBLE_S, EVERY_STOP, PAPER_CONTINUITY, time_double_s, time_quintic

NOTICEABLE = 1e-3  # relative; less than this above the best law is no cost worth a sentence


@dataclass(frozen=True)
class Gain:
    """What an objective came to, and what the quintic at the same times of arrival comes to."""

    objective: Objective
    value: float
    reference: float | None
    reference_holds: bool
    arrivals: bool

    @property
    def part(self) -> float | None:
        """How much less, as a part of the quintic's; None where that has no bound or is no measure."""
        return 1 - self.value / self.reference if self.reference and isfinite(self.reference) else None


def measure_gain(design: Design) -> Gain | None:
    """What was gained in the objective at equal time; None where the time itself is what is made least.

    The quintic is stretched to the times of arrival that are given, and to the total time of the law. It
    goes from rest to rest, and measures no motion that begins or ends at speed.
    """
    objective: Objective = OBJECTIVES[design.problem.objective.minimise]
    if objective.separable and len(design.route.legs) not in design.requirements.arrivals:
        return None
    objective = CALM if objective.separable else objective  # where the end is given, a calm law is chosen
    requirements, timings = design.requirements, design.solution.timings
    moving, value = sum_durations(timings), objective.measure(requirements.demands, timings)
    if design.through is not None:
        if design.through.spent is None:
            return None
        moving = design.optimised.law.duration - requirements.dwell_time
        value = design.through.spent
    quintic = time_quintic(requirements, list_budgets(requirements, moving)).timings
    if any(run.moving for run in requirements.by_run(design.route)):
        return Gain(objective, value, None, False, bool(requirements.arrivals))
    smooth = objective.continuity <= PAPER_CONTINUITY
    reference = objective.measure(requirements.demands, quintic) if smooth else inf
    holds = used_fraction(requirements.demands, quintic) <= 1
    return Gain(objective, value, reference, holds, bool(requirements.arrivals))


def describe_outcome(design: Design, rows: Sequence[LawRow]) -> list[str]:
    """The law's time or effort against quintic and limit, what its easing costs, its control cycle."""
    cycle = design.problem.output.grid
    told = f"It was stretched to end on a multiple of the control cycle of {1000 * (cycle or 0.0):.6g} ms."
    return [*_describe(design, rows), *([told] if cycle is not None else [])]


def _describe(design: Design, rows: Sequence[LawRow]) -> list[str]:
    if design.through is not None:
        return describe_passing(design, design.through)
    best = rows[0]
    limit = best.duration / best.to_limit
    above = "; no physical limit of it is known"
    if limit:
        above = f", {100 * (best.to_limit - 1):.2f} % above the physical limit of {limit:.6g} s"
    gain = measure_gain(design)
    if gain is not None:
        free = design.problem.objective.weight is not None
        asked = "" if free else ", as asked"
        return [f"The law takes {best.duration:.6g} s{asked}{above}.", _describe_gain(gain)]
    less = "less" if best.to_quintic <= 1 else "more"
    change = f"{abs(100 * (1 - best.to_quintic)):.1f} % {less} than the paper's quintic"
    first = f"The optimised law takes {best.duration:.6g} s: {change}{above}."
    return [first, *_describe_cost(design, rows, limit)]


def _describe_gain(gain: Gain) -> str:
    objective, unit = gain.objective, f" {gain.objective.unit}" if gain.objective.unit else ""
    found = f"Its {objective.symbol} is {gain.value:.5g}{unit}"
    if gain.reference is None:
        return f"{found}; the quintic goes from rest to rest, and is no measure of a motion that does not."
    if gain.part is None:
        return f"{found}; that of the quintic has no bound, for a rate below it jumps at the nodes."
    less = "less" if gain.part >= 0 else "more"
    times = " and with the given times of arrival" if gain.arrivals else ""
    beyond = "" if gain.reference_holds else ", which then breaks its limits"
    return (
        f"{found}, {abs(100 * gain.part):.1f} % {less} than the {gain.reference:.5g}{unit} of the quintic "
        f"in the same total time{times}{beyond}."
    )


def _describe_cost(design: Design, rows: Sequence[LawRow], limit: float) -> list[str]:
    """What the chosen easing costs against the best that its continuity allows, and what it gives."""
    best, asked, easing = rows[0], design.problem.nodes.continuity, design.problem.easing
    within = easing.kind.allowed_excess(easing)
    told = []
    if easing.kind.searched and best.to_limit > 1 + within:
        told.append(
            f"No easing that was tried came within {100 * within:g} % of the limit; this is the fastest."
        )
    reference = _find_reference(design, limit)
    if reference is None or best.duration <= reference.duration * (1 + NOTICEABLE):
        return told
    cost = f"{100 * (best.duration / reference.duration - 1):.2f} % against {reference.words}"
    gives = (
        "; for that its jerk does not jump inside the legs"
        if design.optimised.certificate.continuity.inside >= 3
        else ""
    )
    nearer = within / 10 if easing.kind.searched else 0.01
    ways = [
        *(["{basis: double-s}"] if reference.chosen else []),
        f"{{basis: auto, within: {100 * nearer:g} %}}",
    ]
    allowed = f"which continuity {asked} {'allows' if reference.attained else 'only lets a law come near to'}"
    change = f'the key "easing" changes it, as in {" or ".join(ways)}'
    return [*told, f"The chosen easing, {design.family.label}, costs {cost}, {allowed}{gives}; {change}."]


@dataclass(frozen=True)
class _Reference:
    """What an easing is measured by; `chosen`: `basis: double-s` gives it; `attained`: it is a law."""

    words: str
    duration: float
    chosen: bool
    attained: bool


def _find_reference(design: Design, limit: float) -> _Reference | None:
    """The double-S where it is as smooth as is asked, else the physical limit; None where it says little.

    With given times, or ends at speed, no double-S is to be had, and the limit is a bound that laws stay
    away from; so it is where the legs of a run differ in their limits, or under coupled ones.
    """
    requirements, asked = design.requirements, design.problem.nodes.continuity
    runs = requirements.by_run(design.route)
    if requirements.arrivals or not all(run.elastic for run in runs):
        return None
    if min(classify_profile(run.demands) for run in runs) >= asked:
        through, stopping = (_time_double_s(design, stop=stop) for stop in (False, True))
        if stopping < through:
            return _Reference(f"the double-S with every stop, {stopping:.6g} s", stopping, False, True)
        return _Reference(f"the double-S of {through:.6g} s", through, True, True)
    tight = all(
        len({demand.rows_key() for demand in run.demands}) == 1
        and not has_coupling(run.demands[0].rows)
        and rate_bounds(run.demands[0].rows)[-1] == inf
        for run in runs
    )
    return _Reference(f"the physical limit of {limit:.6g} s", limit, False, False) if tight else None


def _time_double_s(design: Design, *, stop: bool) -> float:
    """Its time [s], as the baselines have it where it is one of them."""
    single = all(len(run.demands) == 1 for run in design.requirements.by_run(design.route))
    name = EVERY_STOP if stop and not single else DOUBLE_S
    known = next((b.law.duration for b in design.baselines if b.name == name), None)
    return time_double_s(design.route, design.requirements, stop=stop).duration if known is None else known
