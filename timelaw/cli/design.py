"""`timelaw design`: design, write the files, say how it went."""

import hashlib
from pathlib import Path
from typing import Any

from timelaw.cli.console import print_json, print_limits, print_table, say, show_progress
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS
from timelaw.export import format_law, format_samples
from timelaw.files import write_text
from timelaw.pipeline import Design, design
from timelaw.report import LawRow, list_law_rows, render_report

RESULTS = Path("results")


def run(problem: str, output: str | None, *, as_json: bool) -> int:
    """Design the law of a problem file and write its results; returns the exit code."""
    path = Path(problem)
    with show_progress() as report:
        done = design(path, report)
        folder = Path(output) if output is not None else RESULTS / done.problem.name
        with done.source.placed():
            files = _files(done, path)
        for name, text in files.items():
            write_text(folder / name, text)
    rows = list_law_rows(done)
    certificate = done.optimised.certificate
    _print(done, rows, folder)
    code = EXIT_DONE if certificate.holds else EXIT_FINDINGS
    if as_json:
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": done.problem.name,
                "files": [str(folder / name) for name in files],
                "laws": [row.to_dict() for row in rows],
                "certificate": certificate.to_dict(),
                "findings": certificate.findings(),
            }
        )
    return code


def _files(done: Design, path: Path) -> dict[str, str]:
    """Texts by file name; the law file comes first."""
    digest = "sha256:" + hashlib.sha256(done.source.text.encode("utf-8", "replace")).hexdigest()
    provenance: dict[str, Any] = {
        "problem": path.name,
        "problem_digest": digest,
        "solver": [
            {"status": s.status.value, "rounds": s.rounds, "iterations": s.iterations, "gap": s.gap}
            for s in done.solution.solutions
        ],
    }
    law = done.optimised.law
    return {
        "law.json": format_law(law, done.optimised.certificate, provenance),
        "samples.csv": format_samples(law, done.problem.output.rate),
        **render_report(done, digest),
    }


def _print(done: Design, rows: list[LawRow], folder: Path) -> None:
    print_table(
        ["law", "time [s]", "to quintic", "to limit", "peak/limit", "class"],
        [
            [
                row.name,
                f"{row.duration:.4f}",
                f"{row.to_quintic:.4f}",
                f"{row.to_limit:.4f}",
                f"{max(row.peaks.values()):.6f}",
                f"C{row.continuity}",
            ]
            for row in rows
        ],
    )
    print_limits(done.optimised.certificate)
    for finding in done.optimised.certificate.findings():
        say(f"finding: {finding}")
    for status in sorted({s.status.value for s in done.solution.solutions}):
        say(f"{done.family.label}: {status}")
    verdict = "certified: all limits hold for all t" if rows[0].holds else "NOT certified"
    say(f"{verdict}; report: {folder / 'report.html'}")
