"""Tours of minimal legs through any set, ever straighter: the search over runs by chance, its budget lowered.

It begins with a path or cycle by Pósa's rotations; each tour found sets the budget of the next attempt.
"""

from collections.abc import Iterator
from random import Random

from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.search.hamiltonian import find_path
from timelaw.tours.search.run_search import Corner, RunSearch

Order = tuple[int, ...]
SEED = 20170112
ATTEMPTS = 100
STATES = 150_000  # of all attempts: some five seconds for fifty nodes
LESS = 1e-6  # of the least corner; what the next tour must save


def descend(
    graph: MinimalLegs,
    ends: Ends,
    corner: Corner,
    enough: float,
    known: Order | None = None,
    progress: Progress | None = None,
) -> Order | None:
    """A tour by minimal legs whose corners cost little, the same one every time; None if none is found.

    `known` is a tour to begin from; the search is over when inner corners cost no more than `enough`.
    """
    best = known or find_path(graph.neighbours, ends)
    random = Random(SEED)
    backwards = not ends.closed and ends.start is None and ends.end is not None
    search = RunSearch(graph, ends.closed, float("inf"), corner, random, alike=False)
    search.steps = max(STATES // ATTEMPTS, 2 * len(graph))
    search.end = None if backwards else ends.end
    for attempt, start in enumerate(_starts(ends, len(graph), random)):
        if progress is not None:
            progress("straight tours", attempt, ATTEMPTS)
        if best is not None:
            if _cost(search, best) <= enough:
                break
            search.budget = _whole(search, best) - LESS * search.least
        search.start = start
        found = search.run()
        if found is not None:
            best = found[::-1] if backwards else found
    return best


def _starts(ends: Ends, count: int, random: Random) -> Iterator[int]:
    """Where each attempt begins."""
    given = ends.start if ends.start is not None or ends.closed else ends.end
    for _ in range(ATTEMPTS):
        yield int(random.random() * count) if given is None else given


def _cost(search: RunSearch, order: Order) -> float:
    """What the inner corners cost."""
    visits = list_visits(order, closed=search.closed)
    return sum(search.costs.get(corner, 0.0) for corner in zip(visits, visits[1:], visits[2:], strict=False))


def _whole(search: RunSearch, order: Order) -> float:
    """What all corners cost, as the search counts: where a closed tour begins, too."""
    closing = search.costs.get((order[-1], order[0], order[1]), 0.0) if search.closed else 0.0
    return _cost(search, order) + closing
