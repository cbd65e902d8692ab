"""Shortest tours of any set: against all permutations, against the best known, and the gaps they report."""

import json
from itertools import pairwise, permutations
from pathlib import Path

import numpy as np
import pytest

from tests.cases import problem, unit_quaternions
from timelaw.errors import InputError
from timelaw.orientations import OrientationSet
from timelaw.tours import find_tour, sharpen
from timelaw.tours.ends import Ends
from timelaw.tours.graph.distances import measure_distances
from timelaw.tours.search.costs import CostMatrix
from timelaw.tours.search.held_karp import TreeBound
from timelaw.tours.shortest import find_cheapest, find_short_tour

KINDS = [Ends(True), Ends(True, 2), Ends(), Ends(False, 3), Ends(False, None, 1), Ends(False, 4, 0)]


def random_set(seed, count):
    q = unit_quaternions(np.random.default_rng(seed), count)
    return OrientationSet(q, tuple(str(i + 1) for i in range(count)), "list")


def angles(q):
    """Rotation angles by arccos, as in SOURCES."""
    found = 2 * np.arccos(np.clip(np.abs(q @ q.T), 0, 1))
    np.fill_diagonal(found, 0)
    return found


def length(costs, order, closed):
    visits = [*order, order[0]] if closed else list(order)
    return sum(costs[a, b] for a, b in pairwise(visits))


def allowed(order, ends):
    if ends.closed:
        return order[0] == (ends.start or 0)
    return ends.start in (None, order[0]) and ends.end in (None, order[-1])


@pytest.mark.parametrize("ends", KINDS, ids=str)
def test_small_sets_by_all_permutations(ends):
    for seed in range(2):
        costs = angles(random_set(seed, 7).quaternions)
        orders = [o for o in permutations(range(7)) if allowed(o, ends)]
        best = min(length(costs, o, ends.closed) for o in orders)
        order, total = find_cheapest(CostMatrix(costs), ends)
        assert allowed(order, ends)
        assert total == pytest.approx(best, rel=1e-12)
        assert length(costs, order, ends.closed) == pytest.approx(best, rel=1e-12)
        searched = find_short_tour(CostMatrix(costs), ends, TreeBound(CostMatrix(costs), ends))
        assert allowed(searched, ends)
        assert sorted(searched) == list(range(7))
        assert length(costs, searched, ends.closed) == pytest.approx(best, rel=1e-12)


@pytest.mark.parametrize("ends", KINDS, ids=str)
@pytest.mark.parametrize("count", [5, 9, 13])
def test_the_lower_bound_is_below_the_shortest_and_near_it(ends, count):
    gaps = []
    for seed in range(8):
        costs = CostMatrix(angles(random_set(100 + seed, count).quaternions))
        _, best = find_cheapest(costs, ends)
        for reached in (best, 1.2 * best):  # also where the tour that sets the steps is a bad one
            bound = TreeBound(costs, ends).find(reached)
            assert bound <= best * (1 + 1e-12)
            gaps.append(1 - bound / best)
    assert np.median(gaps) < 0.03


def test_the_search_leaves_no_mark_on_the_costs_and_visits_all():
    costs = angles(random_set(1, 40).quaternions)
    kept, legs = costs.copy(), CostMatrix(costs)
    assert sorted(find_short_tour(legs, Ends(), TreeBound(legs, Ends()))) == list(range(40))
    np.testing.assert_array_equal(costs, kept)


BEST_KNOWN = json.loads((Path(__file__).parent / "data" / "best_known_tours.json").read_text())


@pytest.mark.parametrize(
    ("count", "closed"),
    [
        *((100, closed) for closed in (False, True)),
        pytest.param(300, False, marks=pytest.mark.campaign),
        pytest.param(300, True, marks=pytest.mark.campaign),
        *(pytest.param(1000, closed, marks=pytest.mark.campaign) for closed in (False, True)),
    ],
)
def test_random_sets_against_the_best_tours_known(count, closed):
    """Within 1 % of the best known; the gap that is reported is not smaller than the true one.

    The tours stand in a file of data, found by long runs of strong solvers; their lengths are computed here.
    """
    points = random_set(count, count)
    spec = problem(
        f"route: {{orientations: {{lattice: 24-cell}}, tour: shortest, closed: {str(closed).lower()}}}"
    )
    found = find_tour(spec, points)
    costs = angles(points.quaternions)
    own = length(costs, found.order, closed)
    assert sorted(found.order) == list(range(count))
    assert found.length == pytest.approx(own, rel=1e-9)
    known = BEST_KNOWN[f"{count} {'closed' if closed else 'open'}"]
    assert sorted(known["order"]) == list(range(count))
    assert length(costs, known["order"], closed) == pytest.approx(known["length"], rel=1e-9)
    best = min(known["length"], own)
    assert own <= 1.01 * best
    (merit,) = found.merits
    assert merit.bound <= best * (1 + 1e-9)
    assert own / best - 1 <= merit.gap
    assert merit.gap < 0.03


def test_the_same_tour_every_time():
    points = random_set(5, 60)
    spec = problem("route: {orientations: {lattice: 24-cell}, tour: shortest}")
    assert find_tour(spec, points) == find_tour(spec, points)


def test_start_and_end_of_a_larger_set():
    points = random_set(6, 60)
    spec = problem("route: {orientations: {lattice: 24-cell}, tour: shortest, start: 17, end: 40}")
    found = find_tour(spec, points)
    assert (found.order[0], found.order[-1]) == (16, 39)
    free = find_tour(problem("route: {orientations: {lattice: 24-cell}, tour: shortest}"), points)
    assert free.length < found.length
    assert found.merits[0].bound > free.merits[0].bound


@pytest.mark.parametrize("name", ["600-cell", "120-cell"])
def test_lattices_from_and_to_given_nodes(name):
    from timelaw.orientations.lattices import make_lattice

    q = make_lattice(name)
    points = OrientationSet(q, tuple(str(i + 1) for i in range(len(q))), name, name)
    for ends in ("start: 5", "start: 5, end: 44", "end: 20", "closed: true, start: 30"):
        spec = problem(f"route: {{orientations: {{lattice: {name}}}, tour: shortest, {ends}}}")
        found = find_tour(spec, points)
        assert found.is_shortest
        if "start" in ends:
            assert points.labels[found.order[0]] == str(spec.route.start)
        if spec.route.end:
            assert points.labels[found.order[-1]] == spec.route.end


def test_where_no_tour_has_minimal_legs_only_the_shortest_has_a_longer_one():
    """The tesseract's nearest neighbours are two camps, so an open tour of all eight ends in the other one."""
    points = OrientationSet(
        np.array([(0.5, x, y, z) for x in (0.5, -0.5) for y in (0.5, -0.5) for z in (0.5, -0.5)]),
        tuple("abcdefgh"),
        "list",
    )
    spec = problem("route: {orientations: {lattice: tesseract}, tour: shortest, start: a, end: d}")
    found = find_tour(spec, points)
    assert np.degrees(found.length) == pytest.approx(6 * 120 + 180)
    assert found.is_shortest
    assert found.merits[0].proof == "all tours compared"


def test_a_given_tour_gets_its_true_gap():
    points = random_set(8, 9)
    given = find_tour(problem("route: {orientations: {lattice: 24-cell}, tour: given}"), points)
    sharp = sharpen(given, points)
    best = find_cheapest(CostMatrix(angles(points.quaternions)), Ends())[1]
    assert sharp.merits[0].bound == pytest.approx(best, rel=1e-12)
    assert sharp.merits[0].gap == pytest.approx(given.length / best - 1, rel=1e-9)
    assert given.merits[0].bound < best


def test_many_neighbours_at_one_distance():
    """Ties everywhere: a grid of turns about two axes."""
    from scipy.spatial.transform import Rotation

    grid = [(a, b) for a in range(0, 90, 15) for b in range(0, 90, 15)]
    q = Rotation.from_euler("ZY", grid, degrees=True).as_quat(scalar_first=True)
    points = OrientationSet(q, tuple(str(i) for i in range(len(q))), "list")
    found = find_tour(problem("route: {orientations: {lattice: 24-cell}, tour: shortest}"), points)
    assert sorted(found.order) == list(range(36))
    assert found.length >= found.merits[0].bound > 0


TWICE = "orientations: {list: [[1,0,0,0], [0,1,0,0], [-1,0,0,0], [0,0,1,0]]}"


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        (
            f"{TWICE}, tour: shortest",
            "route.orientations: some orientations are the same: 3 is 1; add duplicates: merge",
        ),
        (
            "orientations: {lattice: 24-cell}, tour: shortest, start: 13",
            'route.start: no orientation is called "13"; there are 1, 2, 3, 4, 5, 6, … (12 in all)',
        ),
        (
            "orientations: {list: [[1,0,0,0], [0,1,0,0]]}, tour: fastest",
            "route.tour: two orientations have one tour only; use given",
        ),
    ],
)
def test_what_cannot_be_searched(spec, message):
    from pathlib import Path

    from timelaw.orientations import read_orientations

    made = problem(f"route: {{{spec}}}")
    with pytest.raises(InputError) as error:
        find_tour(made, read_orientations(made.route.orientations, Path()))
    assert str(error.value) == message


@pytest.mark.parametrize(
    ("route", "message"),
    [
        (
            "tour: shortest, start: 3, end: 3",
            'route.end: "3" is the start too; a tour that ends where it starts is "closed: true"',
        ),
        (
            "tour: shortest, closed: true, end: 3",
            'route.end: a closed tour ends where it starts; leave "end" away',
        ),
        (
            "tour: paper, start: 3",
            "route.start: it belongs to a tour that is searched: shortest, fewest-stops, least-turning, fastest",
        ),
        ("tour: fastest, start: true", "route.start: a label is a number or a text, not True"),
    ],
)
def test_ends_that_make_no_sense(route, message):
    with pytest.raises(InputError) as error:
        problem(f"route: {{orientations: {{lattice: 24-cell}}, {route}}}")
    assert message in str(error.value)


def test_distances_agree():
    q = random_set(2, 20).quaternions
    np.testing.assert_allclose(measure_distances(q), angles(q), atol=1e-7)
