"""`python -m tests.exact.bounds --count 50000 --seed 1`: proved bounds against exact maxima.

For random and adversarial arcs, rational segments, ways of the origin and deviations every bound of a certificate is compared with the exact
maximum of what it bounds. It may never be lower; by how much it is higher, its slack, is shown by kind of
segment and quantity, for all and for those that are well scaled: of which nothing cancels to less than a
thousandth. Some fifteen minutes on one core, of which rational segments take most.
"""

import argparse
import json
import os
import sys
import warnings
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from flint import arb

from tests.exact import arcs, curve_cases, path_cases
from tests.exact.limits import Limited, list_limited
from tests.exact.motion import Motion
from tests.exact.rational import largest
from timelaw.certificate import certify
from timelaw.law_file import from_document

WELL_SCALED = 1e-3  # of what the quantity would be if nothing cancelled
CHUNK = 20  # cases a process takes at once
CURVED, PATHS = 0.25, 0.1  # of the cases
MAKERS = {"arc": arcs.make_case, "rational": curve_cases.make_case, "path": path_cases.make_case}


@dataclass(frozen=True)
class Compared:
    """One bound beside the exact maximum: `slack` is upper/maximum - 1."""

    quantity: str
    slack: float
    well_scaled: bool
    too_low: bool
    number: int = -1


def make_case(seed: int, number: int, kind: str | None = None) -> dict[str, Any]:
    """The case of that number: a document of one segment, of one kind if it is named."""
    share = Random(f"{seed}/{number}/kind").random()
    drawn = "rational" if share < CURVED else "path" if share < CURVED + PATHS else "arc"
    return MAKERS[kind or drawn](seed, number)


def compare(document: dict[str, Any], number: int = -1) -> list[Compared]:
    """Every bound of the law's certificate beside the exact maximum of what it bounds."""
    with np.errstate(over="ignore", invalid="ignore"):
        proved = {c.limit: c.upper for c in certify(from_document(document)).limits}
    motion = Motion(document)
    exact: dict[str, list[Limited]] = defaultdict(list)
    for one in list_limited(motion):
        exact[one.label].append(one)
    if set(exact) != set(proved):
        return [Compared(f"names differ: {sorted(set(exact) ^ set(proved))}", 0.0, False, True, number)]
    who = _name_actuator(motion)
    kind = "path" if motion.travels else document["segments"][0]["kind"]
    return [_compare_one(proved[label], same, (kind, who), number) for label, same in exact.items()]


def _name_actuator(motion: Motion) -> str:
    if not motion.wheels:
        return "external"
    return "wheels with momentum" if any(motion.momentum) else "wheels"


def _compare_one(upper: float, same: list[Limited], what: tuple[str, str], number: int) -> Compared:
    maximum = largest([one.maximum for one in same])
    label = same[0].label.split(" on ")[0]
    name, by_axis = label.split(" ")[0], " " in label
    kind, who = what
    of_body = f", {who}" if name in ("torque", "momentum") else ""
    quantity = f"{kind}: {name}{of_body}" + (", by axis" if by_axis else "")
    well = bool(maximum > WELL_SCALED * max(one.gross for one in same))
    if upper == float("inf"):
        return Compared(quantity, float("inf"), False, False, number)
    too_low = not upper >= 0 or bool(arb(upper) < maximum)
    middle = maximum.mid()
    slack = float((arb(upper) - middle) / middle) if maximum > 0 else (float("inf") if upper > 0 else 0.0)
    return Compared(quantity, slack, well, too_low, number)


def work(case: tuple[int, int, str | None]) -> list[Compared]:
    """In a process: one case."""
    warnings.simplefilter("error")
    return compare(make_case(*case), case[1])


@dataclass
class Tally:
    """What came of the bounds of one quantity: counts, the largest slacks, and the largest lack."""

    count: int = 0
    too_low: int = 0
    unbounded: int = 0
    well_scaled: int = 0
    slack: float = 0.0
    well: float = 0.0
    lack: float = 0.0

    def add(self, one: Compared) -> None:
        """Count one more."""
        self.count += 1
        self.too_low += one.too_low
        if one.slack == float("inf"):
            self.unbounded += 1
            return
        self.slack, self.lack = max(self.slack, one.slack), min(self.lack, one.slack)
        if one.well_scaled:
            self.well_scaled += 1
            self.well = max(self.well, one.slack)


def summarise(compared: Iterable[Compared]) -> dict[str, Tally]:
    """By quantity, and of all of a kind together."""
    tallies: dict[str, Tally] = defaultdict(Tally)
    for one in compared:
        kind = one.quantity.split(":")[0]
        for row in (one.quantity, f"{kind}: all", "all"):
            tallies[row].add(one)
    return dict(sorted(tallies.items()))


def show(tallies: dict[str, Tally]) -> str:
    """A table; unbounded are those that are infinite, or not zero where the maximum is."""
    lines = [
        f"{'kind and quantity':52}{'bounds':>8}{'too low':>9}{'by':>10}{'unbounded':>11}{'slack':>10}"
        f"{'well scaled':>13}{'slack':>10}"
    ]
    lines += [
        f"{name:52}{t.count:8}{t.too_low:9}{-t.lack:10.1e}{t.unbounded:11}{t.slack:10.1e}"
        f"{t.well_scaled:13}{t.well:10.1e}"
        for name, t in tallies.items()
    ]
    return "\n".join(lines)


def run(seed: int, count: int, processes: int, folder: Path, kind: str | None = None) -> dict[str, Tally]:
    """Cases until there are `count` bounds; those with one too low are written to `folder`."""
    found: list[Compared] = []
    with get_context("spawn").Pool(processes) as pool:
        for some in pool.imap(work, ((seed, number, kind) for number in range(count)), CHUNK):
            found += some
            if any(one.too_low for one in some):
                folder.mkdir(parents=True, exist_ok=True)
                path = folder / f"bounds-{seed}-{some[0].number}.json"
                path.write_text(json.dumps(make_case(seed, some[0].number, kind), indent=1))
            if len(found) >= count:
                pool.terminate()
                break
    return summarise(found)


def main(arguments: list[str]) -> int:
    """Run and show; 1 if a bound is too low."""
    parser = argparse.ArgumentParser(prog="python -m tests.exact.bounds", description=__doc__)
    parser.add_argument("--count", type=int, default=50000, help="bounds")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kind", choices=sorted(MAKERS), default=None, help="of the segments; else all")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--failures", type=Path, default=Path("exact-failures"))
    options = parser.parse_args(arguments)
    tallies = run(options.seed, options.count, options.processes, options.failures, options.kind)
    print(show(tallies))
    return int(tallies["all"].too_low > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
