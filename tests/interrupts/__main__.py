"""`python -m tests.interrupts --count 300 --seed 1`: rounds of all scenes and signals, and a table of them."""

import argparse
import random
import sys
import tempfile
import time
from itertools import product
from pathlib import Path

from tests.interrupts.rounds import KINDS, Round, play
from tests.interrupts.scenes import make_scenes


def parse(arguments: list[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.interrupts", description=__doc__)
    parser.add_argument("--count", type=int, default=300, help="rounds")
    parser.add_argument("--seed", type=int, default=1, help="of the moments")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="no round begins after them")
    return parser.parse_args(arguments)


def main(arguments: list[str]) -> int:
    """Play the rounds; 1 if any was at fault."""
    options = parse(arguments)
    rng, rounds = random.Random(options.seed), list[Round]()
    ends = time.monotonic() + 60 * options.minutes
    with tempfile.TemporaryDirectory() as base:
        scenes = make_scenes(Path(base))
        for scene in scenes:
            print(f"{scene.name}: results after {scene.replaced:.2f} s of {scene.duration:.2f} s", flush=True)
        pairs = list(product(scenes, KINDS))
        while len(rounds) < options.count and time.monotonic() < ends:
            scene, kind = pairs[len(rounds) % len(pairs)]
            done = play(scene, kind, rng)
            rounds.append(done)
            for fault in done.faults:
                print(f"{len(rounds)}: {done.scene}, {kind} at {done.moment:.3f} s: {fault}", flush=True)
    print(summarise(rounds))
    return int(any(done.faults for done in rounds))


def summarise(rounds: list[Round]) -> str:
    """A row for each scene and signal: rounds, what was left, the longest time from signal to end."""
    lines = ["| command | signal | rounds | old | new | ended before | longest [s] | at fault |"]
    lines.append("|---|---|---:|---:|---:|---:|---:|---:|")
    for scene, kind in dict.fromkeys((done.scene, done.kind) for done in rounds):
        own = [done for done in rounds if (done.scene, done.kind) == (scene, kind)]
        left = [sum(done.left == state for done in own) for state in ("old", "new")]
        longest = max(done.seconds for done in own)
        faults = sum(bool(done.faults) for done in own)
        cells = [scene, kind, len(own), *left, sum(not d.sent for d in own), f"{longest:.2f}", faults]
        lines.append(f"| {' | '.join(map(str, cells))} |")
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
