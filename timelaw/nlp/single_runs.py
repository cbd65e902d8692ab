"""Solve every distinct run of a route once, falling back where the solver fails."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from timelaw.easing import Timing, smoothstep
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import Fault, InfeasibleError
from timelaw.nlp.program import LEAST_PEAK, Program, RunProblem
from timelaw.nlp.solution import Solution, Status, Timings
from timelaw.progress import Progress

SAME_TIME = 2e-6  # relative: the gap that the solver is left with, and where the closed form is the optimum


def solve_runs(problems: Sequence[RunProblem], progress: Progress | None = None) -> Timings:
    """Least-time solutions of all runs; `progress` hears of distinct runs solved, and how many there are."""
    keys = [problem.key() for problem in problems]
    distinct = list(dict.fromkeys(keys))
    solutions = []
    for index, key in enumerate(distinct):
        if progress is not None:
            progress("solving distinct runs", index, len(distinct))
        solutions.append(solve_run(problems[keys.index(key)]))
    of_run = tuple(distinct.index(key) for key in keys)
    timings = tuple(timing for index in of_run for timing in solutions[index].timings)
    return Timings(timings, tuple(solutions), of_run)


def solve_run(problem: RunProblem) -> Solution:
    """The best of: the program from the closed form over the run, from stops at each node, closed form.

    A solver's word is not taken: its law counts only if, stretched to hold the limits, it is at
    least as fast as the closed-form law, which the basis contains.

    Raises:
        InfeasibleError: a run with given times or rates, which has no closed-form law, has no solution.
    """
    from timelaw.nlp.exchange import solve_from  # loads CasADi, which `timelaw verify` has no need of

    known = _closed_form(problem)
    if known.status is not Status.CLOSED_FORM:
        return known
    program, found = Program((problem,)), list[Solution]()
    for status, start in _starts(problem):
        solution = solve_from(program, start)
        if solution is None:
            continue
        optimal = solution.status is Status.OPTIMAL
        found.insert(0, replace(solution, status=status) if optimal else solution)
        if optimal and _plausible(program, solution, known):
            return _fastest(program, found, known)
    if program.elastic and not found:
        found += _from_simpler(problem, program)
    found += [known] if program.elastic else []
    if not any(_plausible(program, solution, known) for solution in found):
        raise InfeasibleError(_why(program, known.timings))
    return _fastest(program, found, known)


def _fastest(program: Program, found: Sequence[Solution], known: Solution) -> Solution:
    """Of the plausible solutions the fastest."""
    plausible = [solution for solution in found if _plausible(program, solution, known)]
    return min(plausible, key=lambda solution: solution.duration)


def _closed_form(problem: RunProblem) -> Solution:
    """The law in closed form, whose status says if nothing is left to be found."""
    whole = problem.family.closed_form(problem.demands)
    known = Solution(whole, Status.CLOSED_FORM)
    if problem.family.rigid:
        return replace(known, status=Status.CHOSEN)
    if problem.elastic and known.duration <= problem.run.limit * (1 + SAME_TIME):
        return replace(known, status=Status.PHYSICAL_LIMIT)
    if problem.elastic and not problem.bases[0].free and len(problem.demands) == 1:
        return replace(known, status=Status.OPTIMAL)
    return known


def _starts(problem: RunProblem) -> Iterator[tuple[Status, Sequence[Timing]]]:
    """Where the solver begins, and what an optimum is called that it finds from there.

    The family's own start; then smoothsteps that stop at each node, in twice their least time: deep
    inside the limits.
    """
    yield Status.OPTIMAL, problem.family.start(problem.demands)
    slow = [smoothstep.time_leg(demand, problem.family.continuity) for demand in problem.demands]
    yield Status.SECOND_START, [timing.stretched(2.0) for timing in slow]


def _from_simpler(problem: RunProblem, program: Program) -> list[Solution]:
    """From the solution of a simpler family, which this one contains; that itself if it gets no better."""
    from timelaw.nlp.exchange import solve_from

    simpler = problem.family.simpler()
    if simpler is None:
        return []
    known = solve_run(replace(problem, family=simpler))
    if known.status is Status.CLOSED_FORM:
        return []
    found = solve_from(program, known.timings)
    if found is None or found.duration > known.duration:
        return [replace(known, status=Status.SIMPLER)]
    return [replace(found, status=Status.SIMPLER) if found.status is Status.OPTIMAL else found]


def _why(program: Program, start: tuple[Timing, ...]) -> Fault:
    """By how much the limits would have to give for the durations and end rates that are given."""
    from timelaw.nlp.exchange import solve_from

    peak = solve_from(replace(program, objective=LEAST_PEAK), start)
    what = "within the given durations and end rates of a run"
    if peak is None:
        return Fault(f"{what} the solver found no law; give more time or another degree", "segments")
    used = used_fraction(program.demands, peak.timings)
    return Fault(f"{what} the limits would have to be {used:.6g} times as large", "segments")


def _plausible(program: Program, solution: Solution, fallback: Solution) -> bool:
    """Faster than the closed form; where time cannot be stretched, within the limits."""
    if program.elastic:
        return solution.duration <= fallback.duration * (1 + SAME_TIME)
    return used_fraction(program.demands, solution.timings) <= 1
