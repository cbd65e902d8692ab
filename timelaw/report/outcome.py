"""What came of a design, in sentences: for the terminal and for the head of the report."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite

from timelaw.easing.time_scaling import used_fraction
from timelaw.nlp.solution import sum_durations
from timelaw.objectives import OBJECTIVES, Objective
from timelaw.pipeline import Design
from timelaw.report.summary import LawRow
from timelaw.requirements.given_times import list_budgets
from timelaw.time_law.baselines import DOUBLE_S, PAPER_CONTINUITY, time_quintic

NOTICEABLE = 1e-3  # relative; less than this above the best law is no cost worth a sentence


@dataclass(frozen=True)
class Gain:
    """What an objective came to, and what the quintic at the same times of arrival comes to."""

    objective: Objective
    value: float
    reference: float
    reference_holds: bool

    @property
    def part(self) -> float | None:
        """How much less, as a part of the quintic's; None where the quintic's has no bound."""
        return 1 - self.value / self.reference if isfinite(self.reference) and self.reference else None


def measure_gain(design: Design) -> Gain | None:
    """What was gained in the objective at equal time; None where the objective is the time itself.

    The quintic is stretched to the times of arrival that are given, and to the total time of the law.
    """
    objective = OBJECTIVES[design.problem.objective.minimise]
    if objective.separable:
        return None
    requirements, timings = design.requirements, design.solution.timings
    quintic = time_quintic(requirements, list_budgets(requirements, sum_durations(timings))).timings
    value = objective.measure(requirements.demands, timings)
    smooth = objective.continuity <= PAPER_CONTINUITY
    reference = objective.measure(requirements.demands, quintic) if smooth else inf
    return Gain(objective, value, reference, used_fraction(requirements.demands, quintic) <= 1)


def describe_outcome(design: Design, rows: Sequence[LawRow]) -> list[str]:
    """The law's time or effort against the quintic and the physical limit, and what its easing costs."""
    best = rows[0]
    limit = best.duration / best.to_limit
    above = f"{100 * (best.to_limit - 1):.2f} % above the physical limit of {limit:.6g} s"
    gain = measure_gain(design)
    if gain is not None:
        asked = ", as asked" if design.problem.objective.total_time is not None else ""
        return [f"The law takes {best.duration:.6g} s{asked}, {above}.", _describe_gain(gain)]
    less = "less" if best.to_quintic <= 1 else "more"
    change = f"{abs(100 * (1 - best.to_quintic)):.1f} % {less} than the paper's quintic"
    first = f"The optimised law takes {best.duration:.6g} s: {change}, {above}."
    return [first, *_describe_cost(design, rows, limit)]


def _describe_gain(gain: Gain) -> str:
    objective, unit = gain.objective, f" {gain.objective.unit}" if gain.objective.unit else ""
    found = f"Its {objective.symbol} is {gain.value:.5g}{unit}"
    if gain.part is None:
        return f"{found}; that of the quintic has no bound, for a rate below it jumps at the nodes."
    less = "less" if gain.part >= 0 else "more"
    beyond = "" if gain.reference_holds else ", which then breaks its limits"
    return (
        f"{found}, {abs(100 * gain.part):.1f} % {less} than the {gain.reference:.5g}{unit} of the quintic "
        f"with the same times of arrival{beyond}."
    )


def _describe_cost(design: Design, rows: Sequence[LawRow], limit: float) -> list[str]:
    """What the chosen easing costs against the best that its continuity allows, and what it gives."""
    best, asked = rows[0], design.problem.nodes.continuity
    double_s = next((row for row in rows if row.name == DOUBLE_S), None)
    known = double_s is not None and double_s.holds and double_s.continuity >= asked
    name, least = (DOUBLE_S, double_s.duration) if double_s and known else ("physical limit", limit)
    if best.duration <= least * (1 + NOTICEABLE):
        return []
    reach = "allows" if known else "only lets a law come near to"
    cost = f"{100 * (best.duration / least - 1):.2f} % against the {name} of {least:.6g} s"
    gives = "; for that its jerk does not jump inside the legs" if design.family.inside >= 3 else ""
    easing = design.problem.easing
    within = easing.kind.allowed_excess(easing) / 10 if easing.kind.searched else 0.01
    ways = [*(["{basis: double-s}"] if known else []), f"{{basis: auto, within: {100 * within:g} %}}"]
    change = f'the key "easing" changes it, as in {" or ".join(ways)}'
    allowed = f"which continuity {asked} {reach}"
    return [f"The chosen easing, {design.family.label}, costs {cost}, {allowed}{gives}; {change}."]
