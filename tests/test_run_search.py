"""The complete search for straight tours, beside one over all subsets; what it proves of the 600-cell."""

import json
from math import degrees, inf

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from timelaw.errors import TimelawError
from timelaw.orientations.lattices import make_lattice
from timelaw.reproduce.straight_tours import main, search
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.search.run_search import RunSearch

Q = make_lattice("24-cell")
NEAR = [[j for j in range(12) if abs(abs(Q[i] @ Q[j]) - 0.5) < 1e-9] for i in range(12)]
GOALS = ("stops", "turning")


def turn(i, j, k):
    """Angle [deg] between the axes of two legs, by SciPy's rotations."""
    one, two, three = Rotation.from_quat(Q[[i, j, k]], scalar_first=True)
    a, b = (one.inv() * two).as_rotvec(), (two.inv() * three).as_rotvec()
    return round(degrees(np.arccos(np.clip(a @ b / np.linalg.norm(a) / np.linalg.norm(b), -1, 1))), 2)


TURNS = {(i, j, k): turn(i, j, k) for j in range(12) for i in NEAR[j] for k in NEAR[j] if i != k}


def price(goal, i, j, k):
    return TURNS[i, j, k] if goal == "turning" else float(TURNS[i, j, k] > 0)


def least(goal, closed):
    """Over all subsets, from node 1 through every neighbour; the corner at a closed tour's start counts."""
    best = inf
    for second in NEAR[0][:1] if closed else NEAR[0]:
        layer = {(1 | 1 << second, 0, second): 0.0}
        for _ in range(10):
            following = {}
            for (mask, i, j), cost in layer.items():
                for k in NEAR[j]:
                    if not mask >> k & 1:
                        key, more = (mask | 1 << k, j, k), cost + price(goal, i, j, k)
                        following[key] = min(following.get(key, inf), more)
            layer = following
        for (_, i, j), cost in layer.items():
            if not closed:
                best = min(best, cost)
            elif j in NEAR[0]:
                best = min(best, cost + price(goal, i, j, 0) + price(goal, j, 0, second))
    return best


def cost(order, goal, closed):
    visits = [*order, order[0], order[1]] if closed else order
    return sum(price(goal, *visits[i : i + 3]) for i in range(len(visits) - 2))


@pytest.mark.parametrize("goal", GOALS)
@pytest.mark.parametrize("closed", [False, True], ids=["open", "closed"])
def test_the_search_ends_at_the_least_of_all_subsets(goal, closed):
    graph, best = MinimalLegs(Q), least(goal, closed)
    for chance in (False, True):
        found = search(graph, goal, in_its_units(goal, best + 0.2), closed=closed, chance=chance)
        assert sorted(found) == list(range(12))
        assert cost(found, goal, closed) == pytest.approx(best, abs=0.1)
    assert search(graph, goal, in_its_units(goal, best - 0.2), closed=closed, chance=False) is None


def in_its_units(goal, most):
    return np.radians(most) if goal == "turning" else most


def stops_counted(_i, _j, _k):
    return 1.0


@pytest.mark.campaign
def test_no_open_tour_of_the_600_cell_has_43_straight_nodes():
    """16 runs, 15 corners: the search ends without one."""
    search = RunSearch(MinimalLegs(make_lattice("600-cell")), False, 15, stops_counted)
    assert search.run() is None
    assert search.finished


@pytest.mark.campaign
def test_no_closed_tour_of_the_600_cell_has_43_straight_nodes():
    search = RunSearch(MinimalLegs(make_lattice("600-cell")), True, 17, stops_counted)
    assert search.run() is None
    assert search.finished


def test_the_command_prints_a_tour_as_the_data_have_it(capsys):
    main(["24-cell", "turning", "423.2"])
    order, said = capsys.readouterr().out.splitlines()
    assert cost(json.loads(order), "turning", closed=False) == pytest.approx(423.17, abs=0.1)
    assert said == "4 straight inner nodes, the axis turns by 423.17°"
    main(["24-cell", "stops", "5", "closed"])
    assert capsys.readouterr().out == "none: the complete search shows that no closed tour has so little\n"


@pytest.mark.parametrize("name", ["16-cell", "tesseract", "120-cell"])
def test_where_nothing_goes_straight_every_node_is_a_corner(name, capsys):
    nodes = len(make_lattice(name))
    main([name, "stops", str(nodes - 3)])
    assert capsys.readouterr().out.startswith("none")
    main([name, "stops", str(nodes - 2), "chance"])
    assert "0 straight inner nodes" in capsys.readouterr().out


@pytest.mark.parametrize(
    "words",
    [[], ["5-cell", "stops", "5"], ["24-cell", "speed", "5"], ["24-cell", "stops", "few"], ["24-cell"] * 4],
)
def test_what_cannot_be_searched(words):
    with pytest.raises(TimelawError, match=r'give a lattice|"few" is not a number'):
        main(words)
