"""`timelaw sweep`: a problem designed over varied keys; a table, a CSV file and the picture of the front."""

from collections import defaultdict
from math import inf, isfinite
from pathlib import Path

from timelaw.cli.console import RESULTS, print_json, print_table, say, show_progress
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS, EXIT_INFEASIBLE
from timelaw.report.figures.front import draw_front
from timelaw.results_folder import repair_results, write_results
from timelaw.study import Outcome, Study, read_study, run_study
from timelaw.study.table import format_study, list_cells, list_headings

COMMAND = "sweep"  # whose results these are, in a folder that may have those of others
HIDDEN = ("continuity", "easing", "status")  # in the CSV file; too wide for a screen


def run(path: str, output: str | None, processes: int | None, *, as_json: bool) -> int:
    """Run a study and write its results; returns the exit code."""
    study = read_study(Path(path))
    folder = Path(output) if output is not None else RESULTS / study.name
    repair_results(folder)
    with show_progress() as report:
        outcomes = run_study(study, processes, report)
    files = {"sweep.csv": format_study(outcomes)}
    groups = _groups(study, outcomes)
    if groups:
        files["front.svg"] = draw_front(study.name, study.effort, groups)
    write_results(folder, COMMAND, files)
    code = _code(outcomes)
    _print(outcomes, folder)
    if as_json:
        rows = [outcome.to_dict() for outcome in outcomes]
        written = [str(folder / name) for name in files]
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": study.name,
                "files": written,
                "designs": rows,
            }
        )
    return code


def _code(outcomes: list[Outcome]) -> int:
    """Done if all that could be designed is certified; infeasible if nothing could be."""
    designed = [outcome for outcome in outcomes if outcome.duration is not None]
    if not designed:
        return EXIT_INFEASIBLE
    return EXIT_DONE if all(outcome.holds for outcome in designed) else EXIT_FINDINGS


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
        if outcome.duration is None or not outcome.holds:
            where = ", ".join(f"{key} = {value}" for key, value in outcome.point.items())
            say(f"{where}: {outcome.status}")
    say(f"{len(outcomes)} designs; table: {folder / 'sweep.csv'}")
