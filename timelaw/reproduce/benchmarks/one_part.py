"""Measure one part in this process and print its table: what the command runs, on one thread, for each.

python -m timelaw.reproduce.benchmarks.one_part NAME [--quick]
"""

from argparse import ArgumentParser
from collections.abc import Sequence

from timelaw.reproduce.benchmarks.machine import describe_machine
from timelaw.reproduce.benchmarks.parts import PARTS
from timelaw.reproduce.benchmarks.table import format_block
from timelaw.reproduce.command import run_main


def main(arguments: Sequence[str]) -> None:
    """Print the table of a part."""
    parser = ArgumentParser(description="measure one part and print its table")
    parser.add_argument("name", choices=PARTS)
    parser.add_argument("--quick", action="store_true")
    given = parser.parse_args(arguments)
    table = PARTS[given.name].measure(quick=given.quick)
    print(format_block(table, describe_machine(), quick=given.quick))


if __name__ == "__main__":
    run_main(main)
