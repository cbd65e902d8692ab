"""Run a study: every point a design of its own, by any executor; what is known already is not done again."""

from collections.abc import Collection, MutableMapping
from contextlib import closing
from dataclasses import dataclass, replace
from typing import Any

from timelaw.errors import InputError
from timelaw.problem.load import check_problem
from timelaw.progress import Progress, tell
from timelaw.study.designer import Designer, make_designer
from timelaw.study.executors import Executor, run_here
from timelaw.study.outcome import Outcome
from timelaw.study.study import Study

MOST_FAILURES = 10  # points that could not be tried, through no fault of theirs: then something else is wrong


@dataclass(frozen=True)
class Plan:
    """Who designs the points of a study, and the points in order, each with its key."""

    designer: Designer
    points: tuple[tuple[str, dict[str, Any]], ...]

    def count_known(self, known: Collection[str]) -> int:
        """How many of the points have their key among these."""
        return sum(key in known for key, _ in self.points)

    def count_unused(self, known: Collection[str]) -> int:
        """How many of these keys are those of none of the points."""
        return len(set(known) - {key for key, _ in self.points})


def plan_study(study: Study) -> Plan:
    """The points of a study and their keys.

    Raises:
        InputError: no point makes a problem.
    """
    _refuse_nonsense(study)
    designer = make_designer(study)
    return Plan(designer, tuple((designer.find_key(point), point) for point in study.points()))


def run_study(
    plan: Plan,
    executor: Executor = run_here,
    known: MutableMapping[str, Outcome] | None = None,
    progress: Progress | None = None,
) -> list[Outcome]:
    """The outcome of every point, in the order of the study; of those not `known` once they are.

    A point that cannot be met, or makes no problem, is an outcome that says so. Where one could not be tried
    (a process was killed again and again, or there is a defect of ours) the others are before it is raised.

    Raises:
        InfeasibleError: a point could not be tried.
    """
    outcomes = {} if known is None else known
    _design_rest(plan.designer, dict(plan.points), executor, outcomes, progress)
    return [replace(outcomes[key], point=point) for key, point in plan.points]


def _design_rest(
    designer: Designer,
    points: dict[str, dict[str, Any]],
    executor: Executor,
    outcomes: MutableMapping[str, Outcome],
    progress: Progress | None,
) -> None:
    """Design the points whose keys have no outcome yet."""
    tasks = [(key, point) for key, point in points.items() if key not in outcomes]
    done, failures = len(points) - len(tasks), list[Exception]()
    with closing(executor(designer, tasks)) as results:
        tell(progress, "designing", done, len(points))
        for number, result in results:
            if isinstance(result, Exception):
                failures.append(result)
                if isinstance(result, InputError) or len(failures) == MOST_FAILURES:
                    break
                continue
            outcomes[tasks[number][0]] = result
            done += 1
            tell(progress, "designing", done, len(points))
    if failures:
        raise failures[-1]


def _refuse_nonsense(study: Study) -> None:
    """Refuse a study none of whose points makes a problem file; it is told at the study's key.

    Raises:
        InputError: what is wrong with the first.
    """
    first: InputError | None = None
    for point in study.points():
        try:
            check_problem(study.base.with_values(point))
        except InputError as error:
            first = first or _place(study, point, error)
        else:
            return
    if first is not None:
        raise first


def _place(study: Study, point: dict[str, Any], error: InputError) -> InputError:
    values = ", ".join(f"{key} = {value}" for key, value in point.items())
    faults = [f"with {values}: {fault.where}: {fault.message}" for fault in error.faults]
    return InputError(*(study.source.fault(("vary",), text) for text in faults))
