"""The part `start`: commands that do little, beside the interpreter and numpy alone."""

from pathlib import Path
from tempfile import TemporaryDirectory

from timelaw.certificate import certify
from timelaw.export.law_json import format_law
from timelaw.reproduce.benchmarks.part import Part
from timelaw.reproduce.benchmarks.problems import POLYNOMIAL, design_data, make_lattice_data
from timelaw.reproduce.benchmarks.stopwatch import run_python
from timelaw.reproduce.benchmarks.table import Table, format_ratio, format_spread

HEADINGS = ("command", "CPU [ms]", "real time [ms]", "memory [MB]", "to numpy alone")
LEGS = 11
REFERENCE = "numpy alone"
COMMANDS = {
    "Python alone": ["-c", "pass"],
    REFERENCE: ["-c", "import numpy"],
    "help": ["-m", "timelaw", "--help"],
    f"`timelaw verify`, {LEGS} legs": ["-m", "timelaw", "verify", "law.json"],
    "`timelaw docs`": ["-m", "timelaw", "docs"],
}
REPEATS = {True: 3, False: 20}  # by quick
NOTES = ("Each command as a process of its own, median (least–most), after one that is not counted.",)


def measure(*, quick: bool) -> Table:
    """Every command."""
    law = design_data(make_lattice_data(LEGS, easing=POLYNOMIAL)).optimised.law
    rows, reference = [], [1.0]
    with TemporaryDirectory() as folder:
        Path(folder, "law.json").write_text(format_law(law, certify(law), {}), encoding="utf-8")
        for name, command in COMMANDS.items():
            spent = [run_python(command, Path(folder)) for _ in range(REPEATS[quick] + 1)][1:]
            cpu = [one.cpu for one in spent]
            reference = cpu if name == REFERENCE else reference
            ratio = format_ratio(cpu, reference) if reference != [1.0] else ""
            memory = f"{max(one.memory for one in spent):.0f}"
            rows.append(
                (
                    name,
                    format_spread(cpu, 1e-3),
                    format_spread([one.real for one in spent], 1e-3),
                    memory,
                    ratio,
                )
            )
    return Table(HEADINGS, tuple(rows), NOTES)


PART = Part("start", HEADINGS, measure)
