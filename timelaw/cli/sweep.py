"""`timelaw sweep`: a problem designed over varied keys; a table, a CSV file and the picture of the front."""

from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from math import inf, isfinite
from pathlib import Path

from timelaw.cli.console import RESULTS, print_json, print_table, say, show_progress
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS, EXIT_INFEASIBLE, InputError
from timelaw.report.figures.front import draw_front
from timelaw.results_folder import repair_results, write_results
from timelaw.study import Outcome, Study, plan_study, read_study, run_study
from timelaw.study.executors import open_executor
from timelaw.study.run import Plan
from timelaw.study.sweep_log import SweepLog, open_log
from timelaw.study.table import format_study, list_cells, list_headings

COMMAND = "sweep"  # whose results these are, in a folder that may have those of others
HIDDEN = ("continuity", "easing", "status")  # in the CSV file; too wide for a screen


def run(path: str, output: str | None, processes: int | None, cluster: str | None, *, as_json: bool) -> int:
    """Run a study and write its results; returns the exit code."""
    study = read_study(Path(path))
    plan = plan_study(study)
    folder = Path(output) if output is not None else RESULTS / study.name
    repair_results(folder)
    with open_executor(processes, cluster) as executor, open_log(folder) as log:
        known = plan.count_known(log)
        _tell_of_log(plan, log)
        with _keeping(log), show_progress(time_left=True) as report:
            outcomes = run_study(plan, executor, log, report)
        _refuse_wrong(outcomes)
        files = {"sweep.csv": format_study(outcomes)}
        groups = _groups(study, outcomes)
        if groups:
            files["front.svg"] = draw_front(study.name, study.effort, groups)
        write_results(folder, COMMAND, files)
    code = _code(outcomes)
    _print(outcomes, folder)
    if as_json:
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": study.name,
                "files": [str(folder / name) for name in files],
                "log": str(log.path),
                "counts": {**_count(outcomes), "from_log": known},
                "designs": [outcome.to_dict() for outcome in outcomes],
            }
        )
    return code


def _tell_of_log(plan: Plan, log: SweepLog) -> None:
    """What is taken from it and what is not, before the work begins."""
    known, unused = plan.count_known(log), plan.count_unused(log)
    if known:
        say(f"{known} of {len(plan.points)} designs are taken from {log.path}; remove it to make them again")
    if unused:
        say(f"{unused} outcomes in {log.path} are of other points, tables or problems: they are not used")
    if log.cut_off or log.unreadable:
        cut = ", and one that was cut off" if log.cut_off else ""
        say(f"{log.unreadable} lines of {log.path} that cannot be read{cut} are not used")


@contextmanager
def _keeping(log: SweepLog) -> Iterator[None]:
    """Whatever ends the work: how to go on."""
    try:
        yield
    except BaseException:
        if log:
            say(f"{len(log)} outcomes are kept in {log.path}; the same command goes on with the others")
        raise


def _refuse_wrong(outcomes: list[Outcome]) -> None:
    """Leave earlier results alone where no point makes a problem.

    Raises:
        InputError: what is wrong with the first.
    """
    if all(outcome.failure == "wrong" for outcome in outcomes):
        raise InputError(f"no point makes a problem: {_name(outcomes[0])}: {outcomes[0].status}")


def _count(outcomes: list[Outcome]) -> dict[str, int]:
    """How many points there are, and how many of each kind."""
    designed = [outcome for outcome in outcomes if not outcome.failure]
    certified = sum(outcome.holds for outcome in designed)
    return {
        "designs": len(outcomes),
        "certified": certified,
        "findings": len(designed) - certified,
        "infeasible": sum(outcome.failure == "infeasible" for outcome in outcomes),
        "wrong": sum(outcome.failure == "wrong" for outcome in outcomes),
    }


def _code(outcomes: list[Outcome]) -> int:
    """Done if all that could be designed is certified; infeasible if nothing could be."""
    counts = _count(outcomes)
    if counts["findings"]:
        return EXIT_FINDINGS
    return EXIT_DONE if counts["certified"] else EXIT_INFEASIBLE


def _groups(study: Study, outcomes: list[Outcome]) -> dict[str, list[tuple[float, float]]]:
    """Points of the picture, one line for each setting of all keys but the last."""
    last = list(study.vary)[-1]
    groups: dict[str, list[tuple[float, float]]] = defaultdict(list)
    for outcome in outcomes:
        if outcome.duration is not None and isfinite(outcome.efforts.get(study.effort, inf)):
            varied = [key for key in study.vary if key != last and len(study.vary[key]) > 1]
            label = ", ".join(f"{key} = {outcome.point[key]}" for key in varied)
            groups[label].append((outcome.duration, outcome.efforts[study.effort]))
    return dict(groups)


def _print(outcomes: list[Outcome], folder: Path) -> None:
    columns = [name for name in list_headings(outcomes) if name not in HIDDEN]
    rows = [
        [f"{c:.5g}" if isinstance(c, float) else str(c) for c in list_cells(o, columns)] for o in outcomes
    ]
    print_table(columns, rows)
    for outcome in outcomes:
        if not outcome.holds:
            say(f"{_name(outcome)}: {outcome.status}")
    say(f"{len(outcomes)} designs; table: {folder / 'sweep.csv'}")


def _name(outcome: Outcome) -> str:
    return ", ".join(f"{key} = {value}" for key, value in outcome.point.items())
