"""Search straightest tours again: `python -m timelaw.reproduce.straight_tours LATTICE GOAL NUMBER`.

GOAL is `stops` with at most NUMBER corners, or `turning` with at most NUMBER degrees, the corner at
the start of a closed tour included. It prints a tour as the data file has it, or that the complete
search has found none. With `closed` as a further word closed tours are searched; with `chance`
continuations are shuffled and attempts start afresh, which finds what exists sooner and proves nothing.
"""

import json
from collections.abc import Sequence
from math import degrees, radians
from random import Random

from timelaw.errors import TimelawError
from timelaw.orientations.lattices import LATTICES, make_lattice
from timelaw.reproduce.command import run_main
from timelaw.tours.ends import list_visits
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.search.run_search import Corner, RunSearch
from timelaw.tours.straightest import count_corner

SEED = 2
STEPS = 1_000_000  # of an attempt by chance
ATTEMPTS = 50
GOALS = ("stops", "turning")


def search(
    graph: MinimalLegs, goal: str, most: float, *, closed: bool, chance: bool
) -> tuple[int, ...] | None:
    """A tour of minimal legs with at most so many corners, or so much turning [rad]; None if there is none.

    Raises:
        TimelawError: by chance none was found, which proves nothing.
    """
    price: Corner = count_corner if goal == "stops" else graph.turn
    if not chance:
        return RunSearch(graph, closed, most, price).run()
    random = Random(SEED)
    for _ in range(ATTEMPTS):
        found = RunSearch(graph, closed, most, price, random, STEPS).run()
        if found is not None:
            return found
    raise TimelawError(f"{ATTEMPTS} attempts of {STEPS} steps have found none; that proves nothing")


def main(arguments: Sequence[str]) -> None:
    """Search, and print what was found."""
    words = [word for word in arguments if word not in ("closed", "chance")]
    closed, chance = "closed" in arguments, "chance" in arguments
    if len(words) != 3 or words[0] not in LATTICES or words[1] not in GOALS:
        raise TimelawError(
            f"give a lattice ({', '.join(LATTICES)}), a goal ({', '.join(GOALS)}) and a number"
        )
    graph = MinimalLegs(make_lattice(words[0]))
    try:
        most = float(words[2])
    except ValueError:
        raise TimelawError(f'"{words[2]}" is not a number') from None
    found = search(
        graph, words[1], most if words[1] == "stops" else radians(most), closed=closed, chance=chance
    )
    if found is None:
        print(f"none: the complete search shows that no {'closed' if closed else 'open'} tour has so little")
        return
    visits = list_visits(found, closed=closed)
    print(json.dumps(found))
    turning = degrees(graph.turning(visits))
    print(f"{graph.straight(visits)} straight inner nodes, the axis turns by {turning:.2f}°")


if __name__ == "__main__":
    run_main(main)
