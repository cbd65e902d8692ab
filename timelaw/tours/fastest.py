"""The fastest tours: least total time under given limits, straight runs counted as a whole."""

from collections.abc import Iterable
from itertools import islice, pairwise

from timelaw.numerics.array import Array
from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.merit import Merit, Searched
from timelaw.tours.search.costs import CostMatrix
from timelaw.tours.search.held_karp import TreeBound
from timelaw.tours.search.subset_dp import MOST_NODES, Move, find_least
from timelaw.tours.shares import bound_shares
from timelaw.tours.shortest import EXACT, TREES, find_short_tour, list_places, open_cycle
from timelaw.tours.travel_times import TravelTimes

Order = tuple[int, ...]

TIME = "time"
ROUNDING = 1e-12  # relative; smaller gains of time are rounding
MOST_MOVES = 4000  # for comparing all: a few seconds
MOST_POLISHED = 150  # nodes; above it moves are not tried one by one
POLISHING = 100_000  # variants of a tour that are timed
STRETCH = 8  # nodes a polishing move takes along


def find_fastest(
    travel: TravelTimes, ends: Ends, known: Iterable[Order] = (), progress: Progress | None = None
) -> Searched:
    """A tour of least time: exact for small sets, otherwise the best found, with a lower bound.

    `known` are tours to begin from, besides the one that is short in time when all nodes are stops.
    """
    count = len(travel.legs)
    runs = _runs(travel, progress)
    exact = _compared(travel, ends, runs)
    if exact is not None:
        return exact
    charges = CostMatrix(_charges(travel, runs))
    trees = TreeBound(charges, ends)
    starts = [find_short_tour(charges, ends, trees, progress), *known]
    if travel.straight_runs:
        legs = CostMatrix(travel.legs)
        starts.append(find_short_tour(legs, ends, TreeBound(legs, ends), progress))
    order = min((o for o in starts if ends.admits(o)), key=lambda o: sum_times(travel, o, closed=ends.closed))
    if travel.straight_runs and count <= MOST_POLISHED:
        order = _polished(travel, order, ends, progress)
    total = sum_times(travel, order, closed=ends.closed)
    bound = max(trees.find(total, progress), 0.0)
    return Searched(order, (Merit(TIME, total + travel.rest, bound + travel.rest, TREES),))


def sum_times(travel: TravelTimes, order: Order, *, closed: bool) -> float:
    """Least time [s] of a tour without its dwells, from rest to rest over each of its runs."""
    visits = list_visits(order, closed=closed)
    return sum(
        float(travel.legs[run]) if len(run) == 2 else travel.run(run)
        for run in travel.straight_runs.split(visits)
    )


def _runs(travel: TravelTimes, progress: Progress | None) -> dict[Order, float] | None:
    """Times of all runs of more than one leg; None if there are too many."""
    found = list(islice(travel.straight_runs.runs(), travel.most_runs + 1))
    if len(found) > travel.most_runs:
        return None
    times = {}
    for at, run in enumerate(found):
        times[run] = travel.run(run)
        if progress is not None:
            progress("times of runs", at, len(found))
    return times


def _compared(travel: TravelTimes, ends: Ends, runs: dict[Order, float] | None) -> Searched | None:
    """All tours compared, runs as moves; None where there are too many."""
    count = len(travel.legs)
    if runs is None or count > MOST_NODES or len(runs) + count * count > MOST_MOVES:
        return None
    moves = [Move(i, j, (j,), float(travel.legs[i, j])) for i in range(count) for j in range(count) if i != j]
    moves += [Move(run[0], run[-1], run[1:], time) for run, time in runs.items()]
    found = None
    for one in _starts(ends, runs):
        result = find_least(count, count, moves, *list_places(count, one))
        if result is not None and (found is None or result.cost < found.cost):
            found = result
    assert found is not None  # every order is a tour
    order = open_cycle(found.nodes, closed=ends.closed)
    total = sum_times(travel, order, closed=ends.closed)
    return Searched(order, (Merit(TIME, total + travel.rest, found.cost + travel.rest, EXACT),))


def _starts(ends: Ends, runs: dict[Order, float]) -> list[Ends]:
    """A closed tour rests where it starts: node 0, or where a run that passes node 0 begins."""
    if not ends.closed or ends.start is not None:
        return [ends]
    return [Ends(True, start) for start in sorted({0, *(run[0] for run in runs if 0 in run[1:-1])})]


def _charges(travel: TravelTimes, runs: dict[Order, float] | None) -> Array:
    """Of each leg the least it can cost as a part of any run: the run's time in equal shares.

    The shares of all legs of a tour add up to its time or less, so a bound on their sum is one on the time.
    """
    if runs is None:
        return bound_shares(travel)
    charges = travel.legs.copy()
    for run, time in runs.items():
        share = time / (len(run) - 1)
        for a, b in pairwise(run):
            charges[a, b] = charges[b, a] = min(charges[a, b], share)
    return charges


def _polished(travel: TravelTimes, order: Order, ends: Ends, progress: Progress | None) -> Order:
    """Improved by turning round and moving stretches, runs counted, until nothing helps."""
    best, tried, improved = sum_times(travel, order, closed=ends.closed), 0, True
    while improved and tried < POLISHING:
        improved = False
        for candidate in _variants(order):
            tried += 1
            time = sum_times(travel, candidate, closed=ends.closed) if ends.admits(candidate) else best
            if time < best * (1 - ROUNDING):
                order, best, improved = candidate, time, True
                break
            if tried >= POLISHING:
                break
        if progress is not None:
            progress("runs", min(tried, POLISHING), POLISHING)
    return order


def _variants(order: Order) -> Iterable[Order]:
    """Stretches turned round, and short ones carried elsewhere, either way round."""
    count = len(order)
    for i in range(count):
        for j in range(i + 1, count):
            yield (*order[:i], *order[i : j + 1][::-1], *order[j + 1 :])
    for i in range(count):
        for j in range(i + 1, min(i + STRETCH, count) + 1):
            stretch, rest = order[i:j], order[:i] + order[j:]
            for at in range(len(rest) + 1):
                yield (*rest[:at], *stretch, *rest[at:])
                yield (*rest[:at], *stretch[::-1], *rest[at:])
