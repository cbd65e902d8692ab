"""`timelaw design` of a motion along Bézier curves: design, write the files, say how it went."""

import hashlib
from pathlib import Path
from typing import Any

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
from timelaw.export.samples import MAX_ROWS_FOUND
from timelaw.files import Content
from timelaw.pipeline_bezier import BezierDesign, design_curves
from timelaw.problem import Problem, Source
from timelaw.progress import tell
from timelaw.report.curves.joint_text import describe_joints, list_joint_data
from timelaw.report.curves.outcome import describe_curves, list_curve_rows
from timelaw.report.curves.page import render_curve_report
from timelaw.results_folder import repair_results, write_results
from timelaw.time_limit import set_aside

REST, REST_OF_CURVE = 2.0, 0.5  # seconds: what proof, report and files take
COMMAND = "design"


def run(path: Path, problem: Problem, source: Source, output: str | None, *, as_json: bool) -> int:
    """Design the law along the curves of a problem and write its results; returns the exit code."""
    folder = Path(output) if output is not None else RESULTS / problem.name
    repair_results(folder)
    with show_progress() as report:
        set_aside(REST + REST_OF_CURVE * len(problem.route.bezier or ()))
        done = design_curves(path, problem, source, report)
        tell(report, "writing samples and report")
        files, left_out = list_files(done)
        write_results(folder, COMMAND, files)
    certificate = done.optimised.certificate
    _print(done, folder)
    say_findings(left_out)
    code = EXIT_DONE if certificate.holds and not left_out else EXIT_FINDINGS
    if as_json:
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": problem.name,
                "stopped_early": done.stopped_early,
                "files": [str(folder / name) for name in files],
                "laws": [row.to_dict() for row in list_curve_rows(done)],
                "joints": list_joint_data(done.joints, done.passed),
                "certificate": certificate.to_dict(),
                "findings": [*certificate.findings(), *left_out],
            }
        )
    return code


def list_files(done: BezierDesign) -> tuple[dict[str, Content], list[str]]:
    """Contents by file name, the law first; and why a format of samples is left out."""
    digest = "sha256:" + hashlib.sha256(done.source.text.encode("utf-8", "replace")).hexdigest()
    provenance: dict[str, Any] = {
        "problem": done.path.name,
        "problem_digest": digest,
        "solver": [
            {
                "status": "stopped" if run.found.stopped else "converged",
                "iterations": run.found.steps,
                "gap": run.gap,
            }
            for run in done.runs
        ],
    }
    files: dict[str, Content] = {
        "law.json": format_law(done.optimised.law, done.optimised.certificate, provenance)
    }
    left_out = []
    options = Options(done.problem.output.rate, most=MAX_ROWS_FOUND)
    for exporter in (exporter for exporter in EXPORTERS.values() if exporter.usual):
        try:
            with done.source.placed():
                files |= exporter.name_files(done.optimised.law, options)
        except InputError as error:  # all else is designed, and worth keeping
            left_out.append(f"{exporter.file_name} is left out: {error}")
    return files | render_curve_report(done, digest), left_out


def _print(done: BezierDesign, folder: Path) -> None:
    certificate = done.optimised.certificate
    print_table(
        ["law", "time [s]", "to quintic", "peak/limit", "class", "limits hold"],
        [
            [
                row.name,
                f"{row.duration:.4f}",
                "-" if row.to_quintic is None else f"{row.to_quintic:.4f}",
                f"{max(row.peaks.values()):.6f}",
                f"C{row.continuity}",
                "yes" if row.limits_hold else "NO",
            ]
            for row in list_curve_rows(done)
        ],
    )
    print_limits(certificate, degrees=done.source.speaks_degrees)
    say_findings(certificate.findings())
    for sentence in (describe_curves(done), *describe_joints(done.joints, done.passed, done.problem)):
        say(sentence)
    verdict = "certified: all limits hold for all t" if certificate.holds else "NOT certified"
    say(f"{verdict}; report: {folder / 'report.html'}")
