"""The tables of speed: `python -m timelaw.reproduce.benchmarks PAGE [--only NAME] [--quick]`.

Each part is measured by a process of its own, on one thread, and its table between its marks on the page
replaced; then the picture of growth, from the tables. A part that fails leaves its table as it was.
"""

import subprocess
import sys
import time
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path

from timelaw.errors import Fault, InfeasibleError
from timelaw.reproduce.benchmarks.growth import draw_page
from timelaw.reproduce.benchmarks.parts import PARTS
from timelaw.reproduce.benchmarks.stopwatch import make_environment
from timelaw.reproduce.command import run_main
from timelaw.reproduce.reference_tables import replace_table

MODULE = "timelaw.reproduce.benchmarks.one_part"


def measure_part(name: str, *, quick: bool) -> str | None:
    """The table of a part as Markdown, by a process of its own; None if it failed, and has said why."""
    command = [sys.executable, "-m", MODULE, name, *(["--quick"] if quick else [])]
    done = subprocess.run(command, env=make_environment(), stdout=subprocess.PIPE, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def main(arguments: Sequence[str]) -> None:
    """Measure the parts and rewrite their tables and the picture.

    Raises:
        InfeasibleError: names the parts that failed.
    """
    parser = ArgumentParser(description="make the tables of speed again")
    parser.add_argument("page", type=Path)
    parser.add_argument("--only", choices=PARTS, action="append", help="this part alone; may be given again")
    parser.add_argument("--quick", action="store_true", help="fewer sizes and repeats: a minute or two")
    given = parser.parse_args(arguments)
    failed = []
    for name in given.only or PARTS:
        begun = time.perf_counter()
        block = measure_part(name, quick=given.quick)
        print(
            f"{name}: {'failed' if block is None else f'{time.perf_counter() - begun:.0f} s'}",
            file=sys.stderr,
        )
        if block is None:
            failed.append(name)
            continue
        text = given.page.read_text(encoding="utf-8")
        given.page.write_text(replace_table(text, block, name), encoding="utf-8")
    draw_page(given.page)
    if failed:
        raise InfeasibleError(Fault("not measured", ", ".join(failed)))


if __name__ == "__main__":
    run_main(main)
