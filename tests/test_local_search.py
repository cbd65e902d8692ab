"""Exchanges, windows and costs of the search for short tours: what they say they save is what they save."""

from itertools import pairwise
from random import Random

import numpy as np
import pytest

from tests.cases import unit_quaternions
from timelaw.numerics.quaternion import angle_between
from timelaw.tours.ends import Ends
from timelaw.tours.graph.distances import Angles, measure_distances
from timelaw.tours.search import local_search
from timelaw.tours.search.costs import CostMatrix, GatedCosts
from timelaw.tours.search.greedy_cycle import join_greedily
from timelaw.tours.search.held_karp import TreeBound
from timelaw.tours.search.lin_kernighan import Cycle
from timelaw.tours.search.local_search import choose_likely
from timelaw.tours.search.windows import Window
from timelaw.tours.shortest import find_short_tour


def cosines(q):
    """Angles by arccos, as in SOURCES."""
    found = 2 * np.arccos(np.clip(np.abs(q @ q.T), 0, 1))
    np.fill_diagonal(found, 0)
    return found


def length(legs, nodes):
    return sum(legs[i, j] for i, j in pairwise([*nodes, nodes[0]]))


@pytest.mark.parametrize("count", [5, 6, 7, 8, 12, 40])
def test_what_is_saved_is_what_the_tour_is_shorter_by(count):
    for seed in range(5):
        legs = cosines(unit_quaternions(np.random.default_rng(seed), count))
        costs, free = CostMatrix(legs), np.zeros(count)
        near = costs.nearest(min(10, count - 1))
        cycle = Cycle(join_greedily(costs, free, near), costs.price(free), choose_likely(costs, free, near))
        before, random = length(legs, cycle.nodes), Random(seed)
        saved = cycle.improve(range(count))
        assert saved == pytest.approx(before - length(legs, cycle.nodes), abs=1e-9)
        for _ in range(20):
            before = length(legs, cycle.nodes)
            cycle.kick(random)
            assert sorted(cycle.nodes) == list(range(count))
            assert length(legs, cycle.nodes) <= before + 1e-9


def test_a_window_leaves_what_is_outside_of_it():
    q = unit_quaternions(np.random.default_rng(7), 60)
    legs = cosines(q)
    costs, free = CostMatrix(legs), np.zeros(60)
    likely = choose_likely(costs, free, costs.nearest(10))
    nodes = [int(node) for node in np.random.default_rng(1).permutation(60)]
    members = np.argsort(legs[5], kind="stable")[:30]
    window = Window(costs, free, likely, nodes, members)
    outside = set(range(60)) - {int(node) for node in window.members}
    assert sorted(window.join()) == list(range(60))
    window.cycle.improve(range(len(window)))
    joined = window.join()
    assert sorted(joined) == list(range(60))
    assert length(legs, joined) < length(legs, nodes)
    kept = {frozenset(leg) for leg in pairwise([*nodes, nodes[0]]) if set(leg) & outside}
    assert kept <= {frozenset(leg) for leg in pairwise([*joined, joined[0]])}


def test_a_search_in_windows_visits_all_and_is_as_good(monkeypatch):
    q = unit_quaternions(np.random.default_rng(3), 120)
    costs = Angles(q)
    whole = find_short_tour(costs, Ends(), TreeBound(costs, Ends()))
    monkeypatch.setattr(local_search, "MOST_AT_ONCE", 50)
    parts = find_short_tour(costs, Ends(), TreeBound(costs, Ends()))
    assert sorted(parts) == list(range(120))
    one, other = (np.sum(angle_between(q[list(o[:-1])], q[list(o[1:])])) for o in (whole, parts))
    assert other <= 1.02 * one


def test_angles_that_are_not_kept_are_those_that_are():
    q = unit_quaternions(np.random.default_rng(2), 30)
    q[1], q[2] = q[0] + [1e-9, 0, 0, 0], -q[0] + [0, 1e-3, 0, 0]
    q /= np.linalg.norm(q, axis=1, keepdims=True)
    kept, asked = measure_distances(q), Angles(q)
    rows = np.array([asked.row(i) for i in range(30)])
    np.fill_diagonal(rows, 0)  # a row's own place means nothing
    np.testing.assert_allclose(rows, kept, atol=1e-12)
    i, j = np.divmod(np.arange(900), 30)
    np.testing.assert_allclose(asked.legs(i, j), kept.ravel(), atol=1e-12)
    leg = asked.price(np.arange(30.0))
    assert leg(0, 2) == pytest.approx(kept[0, 2] + 2, abs=1e-12)
    np.testing.assert_array_equal(asked.nearest(5), CostMatrix(kept).nearest(5))


def test_a_gate_costs_nothing_from_where_a_tour_may_end():
    costs = CostMatrix(cosines(unit_quaternions(np.random.default_rng(4), 8)))
    gated, free = GatedCosts(costs, (3,)), np.zeros(9)
    assert gated.price(free)(8, 3) == gated.legs(np.array([3]), np.array([8]))[0] == gated.row(8)[3] == 0
    assert gated.price(free)(1, 8) == gated.row(1)[8] > np.sum(np.max(costs.costs, axis=1))
    assert gated.nearest(3)[8, 0] == 3
