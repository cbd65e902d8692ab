"""`timelaw compare`: laws, problems and results beside each other, by what is proved of them."""

from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import Any

from timelaw.cli.console import print_json, print_table, say, say_findings, show_progress
from timelaw.errors import EXIT_DONE, EXIT_FINDINGS, Fault, InputError
from timelaw.progress import tell
from timelaw.report.comparison.compared import Compared, name_apart, read_compared
from timelaw.report.comparison.criteria import list_lines, order_names, show_part
from timelaw.report.comparison.page import Comparison, render_comparison
from timelaw.report.comparison.routes import find_route_difference, list_setting_differences
from timelaw.results_folder import repair_results, write_results

COMMAND = "compare"  # whose results these are, in a folder that may have those of others
LEAST, MOST = 2, 12  # laws; more are no picture


def run(given: Sequence[str], output: str | None, *, any_route: bool, as_json: bool) -> int:
    """Compare what is given; returns the exit code."""
    if not LEAST <= len(given) <= MOST:
        raise InputError(f"{len(given)} to compare; {LEAST} to {MOST} are needed")
    folder = None if output is None else Path(output)
    if folder is not None:
        repair_results(folder)
    with show_progress() as report:
        laws = name_apart([read_compared(one, report) for one in given])
        routes = list_route_differences(laws, given, any_route=any_route)
        entries = [law.entry for law in laws]
        settings = list_setting_differences([(entry.name, entry.law) for entry in entries])
        comparison = Comparison(laws, list_lines(entries), routes, settings)
        tell(report, "drawing")
        files = {} if folder is None else render_comparison(comparison)
        if folder is not None:
            write_results(folder, COMMAND, files)
    _print(comparison)
    if folder is not None:
        say(f"page: {folder / 'compare.html'}")
    findings = [f"{e.name}: {finding}" for e in entries for finding in e.certificate.findings()]
    say_findings(findings)
    code = EXIT_FINDINGS if findings else EXIT_DONE
    if as_json:
        written = [] if folder is None else [str(folder / name) for name in files]
        print_json(
            {
                "ok": code == EXIT_DONE,
                "exit_code": code,
                "files": written,
                **list_data(comparison),
                "findings": findings,
            }
        )
    return code


def list_route_differences(laws: Sequence[Compared], given: Sequence[str], *, any_route: bool) -> list[str]:
    """What differs between the routes, one sentence for each law whose route is not the first's.

    Raises:
        InputError: there is such a law, and it was not said that routes may differ.
    """
    first, *others = laws
    told, faults = [], []
    for law, argument in zip(others, given[1:], strict=True):
        what = find_route_difference(first.entry.law, law.entry.law)
        if what:
            told.append(f"{law.entry.name} has another route than {first.entry.name}: {what}")
            message = f"another route than {given[0]}: {what}; compare all the same with --any-route"
            faults.append(Fault(message, "", argument))
    if faults and not any_route:
        raise InputError(*faults)
    return told


def list_data(comparison: Comparison) -> dict[str, Any]:
    """As `--json` prints it: null for what has no bound."""
    names = comparison.names
    return {
        "laws": [
            {
                "name": law.entry.name,
                "source": law.source,
                "certified": law.entry.certificate.holds,
                **{
                    line.criterion.key: line.values[k] if isfinite(line.values[k]) else None
                    for line in comparison.lines
                },
            }
            for k, law in enumerate(comparison.laws)
        ],
        "units": {line.criterion.key: line.criterion.unit for line in comparison.lines},
        "ranking": {
            line.criterion.key: dict(zip(names, line.ranks, strict=True)) for line in comparison.lines
        },
        "differences": [*comparison.routes, *comparison.settings],
    }


def _print(comparison: Comparison) -> None:
    names = comparison.names
    rows = []
    for line in comparison.lines:
        cells = [f"{value:.6g}".replace("inf", "∞") for value in line.values]
        for k in range(1, len(cells)):
            part = show_part(line.difference(k))
            cells[k] += f" ({part})" if part else ""
        unit = f" [{line.criterion.unit}]" if line.criterion.unit else ""
        rows.append([f"{line.criterion.words}{unit}", *cells])
    print_table(["criterion", *names], rows)
    for line in comparison.lines:
        say(f"{line.criterion.words}: {order_names(line, names)}")
    for sentence in (*comparison.routes, *comparison.settings):
        say(f"{sentence}.")
