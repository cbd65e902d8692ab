"""`python -m tests.fuzz --count 200000 --seed 1`: spoil files of the corpus and read them; or print one input."""

import argparse
import os
import sys
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from tests.fuzz.batches import BatchPool, Tally, make_input, split
from tests.fuzz.corpus import KINDS
from tests.fuzz.readers import FAILED, VERDICTS, Outcome

INTERRUPTED = 130


def parse(arguments: list[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--count", type=int, default=2000, help="inputs 0 to COUNT - 1 of the seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--reader", choices=KINDS, default=None, help="one reader alone")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument(
        "--time-limit", type=float, default=10.0, help="CPU time of an input [s]; beyond it hangs"
    )
    parser.add_argument("--failures", type=Path, default=None, help="folder for the inputs that fail")
    parser.add_argument("--input", type=int, default=None, help="write this input to stdout and run it alone")
    return parser.parse_args(arguments)


@dataclass
class Summary:
    """Counts by reader and verdict, and the peak memory [MB]."""

    counts: Counter = field(default_factory=Counter)
    peak: float = 0.0

    @property
    def failed(self) -> bool:
        """Whether any input failed."""
        return any(verdict in FAILED for _, verdict in self.counts)

    def add(self, tally: Tally) -> None:
        """What came of a batch."""
        self.counts.update((reader, outcome.verdict) for _, reader, outcome in tally.outcomes)
        self.peak = max(self.peak, tally.peak)

    def __str__(self) -> str:
        heading = f"{'reader':<10}{'inputs':>9}" + "".join(
            f"{verdict:>{len(verdict) + 4}}" for verdict in VERDICTS
        )
        lines = [heading]
        for reader in (*KINDS, "all"):
            found = [
                sum(n for (r, v), n in self.counts.items() if v == verdict and reader in (r, "all"))
                for verdict in VERDICTS
            ]
            lines.append(
                f"{reader:<10}{sum(found):>9}"
                + "".join(f"{n:>{len(v) + 4}}" for v, n in zip(VERDICTS, found, strict=True))
            )
        return "\n".join([*lines, f"peak memory: {self.peak:.0f} MB"])  # fmt: skip


def main(arguments: list[str]) -> int:
    """Run what is asked for; 1 if an input failed, 130 if interrupted."""
    options = parse(arguments)
    if options.input is not None:
        sys.stdout.buffer.write(make_input(options.seed, options.input, options.reader)[2])
        sys.stdout.flush()
    summary = Summary()
    interrupted = _run(options, summary)
    print(summary)
    return INTERRUPTED if interrupted else int(summary.failed)


def _run(options: argparse.Namespace, summary: Summary) -> bool:
    """Run the inputs; whether it was interrupted."""
    batches = split(options.seed, options.count, options.reader)
    if options.input is not None:
        batches = [type(batches[0])(options.seed, options.input, 1, options.reader)]
    folder = options.failures or Path(f"fuzz-{options.seed}")
    try:
        with BatchPool(options.processes, options.time_limit) as pool:
            for tally in pool.run_all(batches):
                summary.add(tally)
                for number, _, outcome in tally.outcomes:
                    if outcome.verdict in FAILED:
                        _save(folder, options, number, outcome)
    except KeyboardInterrupt:
        return True
    return False


def _save(folder: Path, options: argparse.Namespace, number: int, outcome: Outcome) -> None:
    """The input that failed, and beside it what came of it."""
    folder.mkdir(parents=True, exist_ok=True)
    kind, name, content = make_input(options.seed, number, options.reader)
    path = folder / f"{kind}-{options.seed}-{number}-{name}"
    path.write_bytes(content)
    path.with_name(f"{path.name}.txt").write_text(f"{outcome.verdict}\n{outcome.message}\n", errors="replace")
    last = (outcome.message.strip().splitlines() or [""])[-1]
    print(f"input {number}: {kind}: {outcome.verdict}: {last[:200]}\n  written to {path}", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
