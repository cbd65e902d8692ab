"""`timelaw verify`: prove a law again from its file alone, and compare with what the file says."""

from pathlib import Path

import numpy as np

from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record, list_compared
from timelaw.cli.console import print_json, print_limits, say, say_findings, show_progress
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS
from timelaw.law_file import read_law
from timelaw.progress import tell


def run(path: str, *, as_json: bool) -> int:
    """Verify the law file at `path`; returns the exit code."""
    with show_progress() as report:
        law, document = read_law(Path(path))
        tell(report, f"proving {len(law.segments)} segments")
        with np.errstate(over="ignore", invalid="ignore"):  # what overflows is found not to hold
            certificate = certify(law)
        findings = [*certificate.findings(), *compare_with_record(certificate, document)]
    record = list_compared(document)
    code = EXIT_FINDINGS if findings else EXIT_DONE
    print_limits(certificate)
    say_findings(findings)
    say(record.sentence)
    say(
        f"{law.name}: {certificate.duration:.6f} s, {len(law.segments)} segments, "
        f"C{certificate.order}, " + ("certified" if not findings else "NOT certified")
    )
    if as_json:
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "name": law.name,
                "duration": certificate.duration,
                "certificate": certificate.to_dict(),
                "findings": findings,
                "record": {"compared": record.compared, "not_compared": record.not_compared},
            }
        )
    return code
