"""`timelaw design`: design, write the files, say how it went."""

import hashlib
from math import isfinite
from pathlib import Path
from typing import Any

from timelaw.cli import bezier as cli_bezier
from timelaw.cli.console import (
    RESULTS,
    print_json,
    print_limits,
    print_table,
    say,
    say_findings,
    show_progress,
)
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS, InputError
from timelaw.export import format_law
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS
from timelaw.export.samples import MAX_ROWS_FOUND, refuse_too_many_rows
from timelaw.files import Content
from timelaw.pipeline import Design, Layout, design_layout, lay_out_problem
from timelaw.problem import load_problem
from timelaw.problem.output import find_given_times
from timelaw.progress import tell
from timelaw.report import LawRow, list_law_rows, render_report
from timelaw.report.outcome import describe_outcome, measure_gain
from timelaw.report.passing_text import describe_rungs
from timelaw.report.tour_text import describe_moves
from timelaw.requirements.route_limit import find_route_limit
from timelaw.results_folder import repair_results, write_results
from timelaw.time_limit import refuse_when_over, set_aside

NO_ROUTE = (
    "the time limit ended before the route was known, and so before any law; give more with --time-limit"
)
REST, REST_OF_LEG = 1.0, 0.03  # seconds: what proof, report and files take; samples of long laws take longer
COMMAND = "design"  # whose results these are, in a folder that may have those of others


def run(problem: str, output: str | None, *, as_json: bool) -> int:
    """Design the law of a problem file and write its results; returns the exit code."""
    path = Path(problem)
    with show_progress() as report:
        with refuse_when_over(NO_ROUTE):
            model, source = load_problem(path)
            layout = None if model.route.bezier else lay_out_problem(path, model, source, report)
        if layout is None:
            return cli_bezier.run(path, model, source, output, as_json=as_json)
        set_aside(REST + REST_OF_LEG * len(layout.route.legs))
        _refuse_too_many_samples(layout)
        folder = Path(output) if output is not None else RESULTS / layout.problem.name
        repair_results(folder)
        done = design_layout(layout, report)
        tell(report, "writing samples and report")
        samples, left_out = list_samples(done)  # old ones of what is left out go with the other old results
        files = list_files(done, path, samples)
        rows = list_law_rows(done)
        write_results(folder, COMMAND, files)
    certificate = done.optimised.certificate
    _print(done, rows, folder)
    say_findings(left_out.values())
    code = EXIT_DONE if certificate.holds and not left_out else EXIT_FINDINGS
    if as_json:
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": done.problem.name,
                "stopped_early": done.stopped_early,
                "files": [str(folder / name) for name in files],
                "laws": [row.to_dict() for row in rows],
                **_objective(done),
                **_passing(done),
                "certificate": certificate.to_dict(),
                "findings": [*certificate.findings(), *left_out.values()],
            }
        )
    return code


def _refuse_too_many_samples(layout: Layout) -> None:
    """Before anything is solved, as far as is known: no law is faster than the limit of its route.

    But those that leave its arcs, of which nothing is known.

    Raises:
        InputError: the samples of any law would be too many.
    """
    if layout.problem.motion.through:
        return
    least, asked = find_route_limit(layout.route, layout.requirements), layout.problem.objective.total_time
    with layout.source.placed():
        rate = layout.problem.output.rate
        refuse_too_many_rows(max(least, asked.seconds(least)) if asked else least, rate, "at least")


def _objective(done: Design) -> dict[str, Any]:
    """What was gained where something else than time is made least."""
    gain = measure_gain(done)
    if gain is None:
        return {}
    reference = gain.reference if gain.reference is not None and isfinite(gain.reference) else None
    found = {"value": gain.value, "unit": gain.objective.unit, "quintic_at_equal_times": reference}
    return {"objective": {"minimise": gain.objective.name, **found, "gained": gain.part}}


def _passing(done: Design) -> dict[str, Any]:
    """How many nodes are passed, and what each rung of the search came to."""
    if done.through is None:
        return {}
    passages = [
        {
            "from": done.route.nodes[passage.first].label,
            "to": done.route.nodes[passage.last].label,
            "passed": passage.curve is not None,
            "stopping_time": passage.stopping,
            "rungs": [vars(rung) for rung in passage.rungs],
        }
        for passage in done.through.passages
    ]
    return {"through": {"passed": done.through.passed, "passages": passages}}


def list_files(done: Design, path: Path, samples: dict[str, Content] | None = None) -> dict[str, Content]:
    """Contents by file name: the law, which comes first, its `samples` in the usual formats, its report."""
    digest = "sha256:" + hashlib.sha256(done.source.text.encode("utf-8", "replace")).hexdigest()
    provenance: dict[str, Any] = {
        "problem": path.name,
        "problem_digest": digest,
        "solver": [
            {"status": s.describe(), "rounds": s.rounds, "iterations": s.iterations, "gap": s.gap}
            for s in done.solution.solutions
        ],
    }
    provenance |= _passing(done)
    if done.stopped_early:
        provenance["stopped_early"] = True
    given = list(find_given_times(done.problem))
    if given:
        provenance["given_times"] = given
    law = done.optimised.law
    return {
        "law.json": format_law(law, done.optimised.certificate, provenance),
        **(list_samples(done)[0] if samples is None else samples),
        **render_report(done, digest),
    }


def list_samples(done: Design) -> tuple[dict[str, Content], dict[str, str]]:
    """Contents by file name of the usual formats, and of those that are left out the reason."""
    written: dict[str, Content] = {}
    options = Options(done.problem.output.rate, most=MAX_ROWS_FOUND)
    left_out: dict[str, str] = {}
    for exporter in (exporter for exporter in EXPORTERS.values() if exporter.usual):
        try:
            with done.source.placed():
                written |= exporter.name_files(done.optimised.law, options)
        except InputError as error:  # all else is designed, and worth keeping
            left_out[exporter.file_name] = f"{exporter.file_name} is left out: {error}"
    return written, left_out


def _print(done: Design, rows: list[LawRow], folder: Path) -> None:
    print_table(
        ["law", "time [s]", "to quintic", "to limit", "peak/limit", "class", "limits hold"],
        [
            [
                row.name,
                f"{row.duration:.4f}",
                f"{row.to_quintic:.4f}",
                f"{row.to_limit:.4f}" if isfinite(row.to_limit) else "-",
                f"{max(row.peaks.values()):.6f}",
                f"C{row.continuity}",
                "yes" if row.limits_hold else "NO",
            ]
            for row in rows
        ],
    )
    print_limits(done.optimised.certificate, degrees=done.source.speaks_degrees)
    say_findings(done.optimised.certificate.findings())
    for sentence in describe_outcome(done, rows):
        say(sentence)
    for sentence in (*done.orientations.notes, *describe_moves(done.orientations, done.route)):
        say(sentence)
    for status in sorted({s.describe() for s in done.solution.solutions}) if done.through is None else ():
        say(f"{done.family.label}: {status}")
    for line in describe_rungs(done.route, done.through) if done.through is not None else ():
        say(line)
    verdict = "certified: all limits hold for all t" if rows[0].holds else "NOT certified"
    say(f"{verdict}; report: {folder / 'report.html'}")
