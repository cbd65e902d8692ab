"""Among the tours whose legs are all minimal: those with the fewest stops, or the least turning.

The body need not stop where its next leg goes on along the same great circle. Small sets are
compared exhaustively; for the 600-cell found tours are shipped as data, and what they are worth is
computed when they are loaded, never read. All others are searched by chance, with a bound by counting.
"""

import json
from collections.abc import Sequence
from importlib.resources import files
from itertools import pairwise
from math import floor

from timelaw.errors import Fault, InputError, list_some
from timelaw.orientations.lattices import make_lattice
from timelaw.progress import Progress
from timelaw.tours.ends import Ends, list_visits
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.graph.symmetry import find_congruence, move_tour
from timelaw.tours.merit import EQUAL, Merit, Searched
from timelaw.tours.search.hamiltonian import find_obstacle
from timelaw.tours.search.run_search_descent import descend
from timelaw.tours.search.subset_dp import MOST_CELLS, Move, Start, find_least
from timelaw.tours.shortest import EXACT, open_cycle

DATA = "data/straight.json"
PROVED = "exhaustive search"
COUNTED = "counting"
MOST_STRAIGHTENED = 300  # orientations: half a minute
CALM = 1e-4  # of a stop for a radian of turning: of tours with equally few stops the calmest
STRAIGHT, TURNING = "straight nodes", "turning"
GOALS = {STRAIGHT: "fewest-stops", TURNING: "least-turning"}


def find_straightest(
    graph: MinimalLegs, ends: Ends, goal: str, labels: Sequence[str], progress: Progress | None = None
) -> Searched:
    """The tour of minimal legs with the most straight nodes (`goal` STRAIGHT), or the least TURNING.

    Raises:
        InputError: no tour has minimal legs only, none was found, or the set is too large.
    """
    reason = find_obstacle(graph.neighbours, ends)
    if reason is not None:
        what, nodes = reason
        raise _impossible(goal, f"there are orientations {what}: {list_some([labels[i] for i in nodes])}")
    if len(graph) * 2 ** len(graph) * max(map(len, graph.neighbours)) <= MOST_CELLS:
        return _exact(graph, ends, goal)
    return _shipped(graph, ends, goal) or _searched(graph, ends, goal, progress)


def check_minimal(order: Sequence[int], graph: MinimalLegs, *, closed: bool) -> None:
    """Refuse what does not visit every node once by minimal legs.

    Raises:
        ValueError: a node is missing or repeated, or a leg is longer.
    """
    if sorted(order) != list(range(len(graph))):
        raise ValueError("a tour visits every node once")
    for a, b in pairwise(list_visits(order, closed=closed)):
        if b not in graph.neighbours[a]:
            raise ValueError(f"the leg {a}-{b} is not minimal")


def judge_straightness(
    graph: MinimalLegs, order: Sequence[int], *, closed: bool, bounds: dict[str, tuple[float, str]]
) -> tuple[Merit, ...]:
    """What a tour of minimal legs is worth, beside the bounds known: straight nodes, turning."""
    visits = list_visits(order, closed=closed)
    counted = graph.counting_bound(closed)
    most, proof = bounds.get(STRAIGHT, (counted, COUNTED))
    if most >= counted:
        most, proof = counted, COUNTED
    corners = len(visits) - 2 - most
    little, why = bounds.get(TURNING, (0.0, ""))
    if corners * graph.least_turn >= little:
        little, why = corners * graph.least_turn, f"{corners:.0f} corners × the least turn"
    return (
        Merit(STRAIGHT, graph.straight(visits), most, proof, most=True),
        Merit(TURNING, graph.turning(visits), little, why),
    )


def _searched(graph: MinimalLegs, ends: Ends, goal: str, progress: Progress | None) -> Searched:
    """The best that a search by chance finds; the bound by counting says how good it is at least."""
    if len(graph) > MOST_STRAIGHTENED:
        message = (
            f'"{GOALS[goal]}" is searched for {MOST_STRAIGHTENED} orientations at most, not for {len(graph)}'
        )
        raise InputError(Fault(f'{message}; use "shortest" or "fastest"', "route.tour"))
    corners = len(graph) - 2 + ends.closed - graph.counting_bound(ends.closed)
    order = descend(graph, ends, count_corner, corners, None, progress)
    if goal == TURNING and order is not None:
        calm = corners * graph.least_turn * (1 + EQUAL)
        order = descend(graph, ends, graph.turn, calm, order, progress)
    if order is None:
        raise _impossible(goal, "none was found")
    check_minimal(order, graph, closed=ends.closed)
    return Searched(order, judge_straightness(graph, order, closed=ends.closed, bounds={}))


def count_corner(_i: int, _j: int, _k: int) -> float:
    """The price of a corner where stops are counted."""
    return 1.0


def _exact(graph: MinimalLegs, ends: Ends, goal: str) -> Searched:
    """By dynamic programming over subsets: all tours of minimal legs are compared."""

    def price(i: int, j: int, k: int) -> float:
        turn = graph.turn(i, j, k)
        return turn if goal == TURNING else (turn > 0) + CALM * turn

    count = len(graph)
    arcs = {
        arc: count + index
        for index, arc in enumerate((i, j) for i, near in enumerate(graph.neighbours) for j in near)
    }
    moves = [Move(i, state, (j,), 0.0) for (i, j), state in arcs.items()]
    moves += [
        Move(state, arcs[j, k], (k,), price(i, j, k))
        for (i, j), state in arcs.items()
        for k in graph.neighbours[j]
        if k != i
    ]
    found = None
    for first in range(count) if ends.start is None else [ends.start]:
        goals = [first] if ends.closed else [ends.end] if ends.end is not None else range(count)
        final = [state for (_, j), state in arcs.items() if j in goals]
        start = Start(first, None if ends.closed else first)
        one = find_least(count, count + len(arcs), moves, [start], final)
        if one is not None and (found is None or one.cost < found.cost - 1e-9):
            found = one
    if found is None:
        raise _impossible(goal, "comparing all shows that there is none")
    order = open_cycle(found.nodes, closed=ends.closed)
    inner = count - 2 + ends.closed
    bound = (inner - floor(found.cost), EXACT) if goal == STRAIGHT else (found.cost, EXACT)
    return Searched(order, judge_straightness(graph, order, closed=ends.closed, bounds={goal: bound}))


def _shipped(graph: MinimalLegs, ends: Ends, goal: str) -> Searched | None:
    """A tour from the data of a lattice congruent to the set, carried to it and to the ends; checked."""
    for name, kinds in json.loads(files("timelaw.tours").joinpath(DATA).read_text(encoding="utf-8")).items():
        model = MinimalLegs(make_lattice(name))
        nodes = find_congruence(model.quaternions, graph.quaternions, graph.precision)
        if nodes is None or any(
            {nodes[j] for j in near} != set(graph.neighbours[nodes[i]])
            for i, near in enumerate(model.neighbours)
        ):
            continue
        kind = kinds["closed" if ends.closed else "open"]
        bounds = {STRAIGHT: (kind["most straight nodes"], PROVED)}
        wanted = Ends(ends.closed, *(None if e is None else nodes.index(e) for e in (ends.start, ends.end)))
        for order in kind[GOALS[goal]]:
            carried = move_tour(tuple(order), model.quaternions, wanted)
            if carried is not None:
                found = [nodes[node] for node in carried]
                check_minimal(found, graph, closed=ends.closed)
                return Searched(
                    tuple(found), judge_straightness(graph, found, closed=ends.closed, bounds=bounds)
                )
    return None


def _impossible(goal: str, reason: str) -> InputError:
    message = f'"{GOALS[goal]}" needs a tour whose legs all have the minimal distance, and {reason}'
    return InputError(Fault(f'{message}; use "shortest" or "fastest"', "route.tour"))
