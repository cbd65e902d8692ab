"""Among the tours whose legs are all minimal, those that go straight on at the most nodes.

The body need not stop where its next leg goes on along the same great circle, so these are the
fastest of the shortest. Found tours are shipped as data, and checked when they are loaded; for the
24-cell they reach the counting bound, for the 600-cell they are the best the search has found.
"""

import json
from collections.abc import Sequence
from importlib.resources import files
from itertools import pairwise

from timelaw.errors import Fault, InputError
from timelaw.tours.distance import distances
from timelaw.tours.lines import Lines
from timelaw.tours.shortest import shortest

DATA = "data/fewest_stops.json"


def fewest_stops(name: str, lines: Lines, *, closed: bool) -> tuple[int, ...]:
    """The shipped tour of a lattice, or where none of its tours goes straight anywhere, a shortest one.

    Raises:
        InputError: there is no such tour in the data.
    """
    if not lines.onward:
        return shortest(distances(lines.quaternions), closed=closed)
    known = json.loads(files("timelaw.tours").joinpath(DATA).read_text(encoding="utf-8"))
    order = known.get(name, {}).get("closed" if closed else "open")
    if order is None:
        raise InputError(
            Fault(f'no tour with the fewest stops is known of {name}; use "shortest"', "route.tour")
        )
    check(order, lines, closed=closed)
    return tuple(order)


def check(order: Sequence[int], lines: Lines, *, closed: bool) -> None:
    """Refuse what does not visit every node once by minimal legs.

    Raises:
        ValueError: a node is missing or repeated, or a leg is longer.
    """
    if sorted(order) != list(range(len(lines.quaternions))):
        raise ValueError("a tour visits every node once")
    stops = [*order, order[0]] if closed else list(order)
    for a, b in pairwise(stops):
        if b not in lines.neighbours[a]:
            raise ValueError(f"the leg {a}-{b} is not minimal")
