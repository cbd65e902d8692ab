"""The law that uses the least part of the limits: whether, and by how little not, they can be held at all."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

from timelaw.easing import Timing
from timelaw.easing.time_scaling import used_fraction
from timelaw.nlp.program import LEAST_PEAK, Program
from timelaw.nlp.solution import Solution
from timelaw.nlp.verdicts import Verdict

PACES = (1.0, 0.5, 2.0)  # of a start: a moving run may take less or more time than one from rest to rest
AGREE = 1e-5  # relative; two starts that lead as near to each other lead to one law
SURE = 2  # starts of a moving run that have to agree with one before; of one from rest to rest a single one


def find_least_peak(
    program: Program,
    starts: Sequence[Sequence[Timing]],
    failures: list[Verdict] | None = None,
    enough: float = inf,
) -> Solution | None:
    """The law that uses the least part of the limits, of all starts; None where the solver finds none.

    From each try first with the limits at some points. What is used there only grows as points are added:
    the most promising law is gone on with, and after it those that promised less than it came to. Once it is
    clear that more than `enough` is used no better law is looked for.
    """
    from timelaw.nlp.exchange import solve_from

    peaks = replace(program, objective=LEAST_PEAK, weight=None)
    tries = _list_tries(peaks, starts)
    if len(tries) == 1:
        return solve_from(peaks, tries[0], failures, enough)
    best: tuple[float, Solution] | None = None
    for promised, start, begun in _begin(peaks, tries, failures):
        if best is not None and (promised >= best[0] or best[0] <= 1):
            break
        if promised > enough:
            return begun if best is None else best[1]
        found = solve_from(peaks, start, failures, enough) or begun
        used = used_fraction(program.demands, found.timings)
        if best is None or used < best[0]:
            best = used, found
    return None if best is None else best[1]


def _list_tries(peaks: Program, starts: Sequence[Sequence[Timing]]) -> list[Sequence[Timing]]:
    """Each start, at several paces where times are open; of a large program the first alone."""
    if peaks.large:
        return list(starts[:1])
    open_times = not peaks.budgets and any(demand.duration is None for demand in peaks.demands)
    paces = PACES if open_times else PACES[:1]
    return [[timing.stretched(pace) for timing in start] for pace in paces for start in starts]


def _begin(
    peaks: Program, tries: Sequence[Sequence[Timing]], failures: list[Verdict] | None
) -> list[tuple[float, Sequence[Timing], Solution]]:
    """From each try the part of the limits that is used at some points, and the law; the least first.

    Until one holds the limits, or enough of them agree.
    """
    from timelaw.nlp.exchange import solve_from

    begun: list[tuple[float, Sequence[Timing], Solution]] = []
    agreed = 0
    for start in tries:
        solution = solve_from(peaks, start, failures, most_rounds=1)
        if solution is None:
            continue
        used = used_fraction(peaks.demands, solution.timings)
        promised = used / (1 + solution.gap)
        if any(abs(promised / other - 1) < AGREE for other, _, _ in begun):
            agreed += 1
        else:
            begun.append((promised, start, solution))
        if used <= 1 or agreed >= (SURE if peaks.moving else 1):
            break
    return sorted(begun, key=lambda one: one[0])


def holds_limits(program: Program, solution: Solution) -> bool:
    """Whether the law holds every limit of the program, proved."""
    return used_fraction(program.demands, solution.timings) <= 1
