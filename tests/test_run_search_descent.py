"""Straight tours of any set: beside all tours of small sets, on rings, rows and parts of lattices."""

from itertools import pairwise, permutations

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem
from timelaw.errors import InputError
from timelaw.orientations import OrientationSet
from timelaw.orientations.lattices import make_lattice
from timelaw.tours import find_tour
from timelaw.tours.ends import Ends
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.search.run_search_descent import descend
from timelaw.tours.straightest import STRAIGHT, TURNING, count_corner


def about_z(count, step):
    """`count` orientations about one axis, `step` degrees apart."""
    vectors = np.arange(count)[:, None] * np.array([0.0, 0.0, step])
    return Rotation.from_rotvec(vectors, degrees=True).as_quat(scalar_first=True)


def made(q, spec):
    points = OrientationSet(q, tuple(str(i + 1) for i in range(len(q))), "list")
    spec = problem(f"route: {{orientations: {{lattice: 24-cell}}, {spec}}}")
    found = find_tour(spec, points)
    return found, {merit.name: merit for merit in found.merits}


def judged(order, q, closed):
    """(corners, turning [deg]) of a tour that visits all nodes once by minimal legs, by SciPy's rotations."""
    assert sorted(order) == list(range(len(q)))
    rotations = Rotation.from_quat(q[[*order, order[0]] if closed else list(order)], scalar_first=True)
    vectors = (rotations[:-1].inv() * rotations[1:]).as_rotvec(degrees=True)
    angles = np.linalg.norm(vectors, axis=1)
    minimal = np.degrees(2 * np.arccos(np.max(np.abs(q @ q.T) - 2 * np.eye(len(q)))))
    np.testing.assert_allclose(angles, minimal, rtol=1e-6)
    cosines = np.sum(vectors[:-1] * vectors[1:], axis=1) / angles[:-1] / angles[1:]
    turns = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    return int(np.sum(turns > 1e-4)), float(np.sum(turns[turns > 1e-4]))


@pytest.mark.parametrize("goal", ["fewest-stops", "least-turning"])
def test_a_row_about_one_axis_is_one_run(goal):
    q = about_z(40, 5)[np.random.default_rng(1).permutation(40)]
    found, merits = made(q, f"tour: {goal}")
    assert judged(found.order, q, closed=False) == (0, 0)
    assert merits[STRAIGHT].is_best
    assert merits[TURNING].is_best


@pytest.mark.parametrize("spec", ["closed: true", "closed: true, start: 9", "start: 9", "end: 9"])
def test_a_ring_is_one_run_from_anywhere(spec):
    q = about_z(72, 5)[np.random.default_rng(2).permutation(72)]
    found, merits = made(q, f"tour: fewest-stops, {spec}")
    assert judged(found.order, q, closed="closed" in spec) == (0, 0)
    assert merits[STRAIGHT].is_best
    assert "start" not in spec or found.order[0] == 8
    assert "end" not in spec or found.order[-1] == 8


PART = np.sort(np.random.default_rng(0).permutation(60)[:36])


@pytest.mark.parametrize(
    "spec",
    [", start: 3, end: 17", *(pytest.param(s, marks=pytest.mark.campaign) for s in ("", ", closed: true"))],
)
def test_a_part_of_the_600_cell(spec):
    q = make_lattice("600-cell")[PART]
    straight, merits = made(q, f"tour: fewest-stops{spec}")
    calm, others = made(q, f"tour: least-turning{spec}")
    closed = "closed" in spec
    (corners, turning), (more, less) = (judged(t.order, q, closed) for t in (straight, calm))
    inner = 34 + closed
    assert merits[STRAIGHT].value == inner - corners
    assert np.degrees(others[TURNING].value) == pytest.approx(less, rel=1e-9)
    plain = judged(made(q, f"tour: shortest{spec}")[0].order, q, closed)
    assert corners < 0.7 * plain[0]
    assert less < 0.7 * plain[1]
    assert less <= turning
    for merit in (merits[STRAIGHT], others[TURNING]):
        assert not merit.is_best
        assert merit.gap > 0
    assert inner - merits[STRAIGHT].bound <= min(corners, more)
    assert np.degrees(others[TURNING].bound) <= min(turning, less)
    if "start" in spec:
        assert (straight.order[0], straight.order[-1]) == (2, 16)


def small_sets():
    """Nine nodes of the 600-cell each, in some of which minimal legs lead everywhere."""
    q, rng = make_lattice("600-cell"), np.random.default_rng(8)
    near = np.abs(q @ q.T) > 0.8
    for _ in range(8):
        chosen = [0]
        while len(chosen) < 9:
            chosen.append(int(rng.choice(np.setdiff1d(np.flatnonzero(near[chosen].any(axis=0)), chosen))))
        yield q[chosen]


def corners_of(order, near, graph, closed):
    """Corners of an order, if all legs are minimal."""
    visits = (*order, order[0]) if closed else order
    if not all(near[a][b] for a, b in pairwise(visits)):
        return np.inf
    return len(visits) - 2 - graph.straight(visits)


@pytest.mark.parametrize("ends", [Ends(), Ends(False, 2), Ends(True)], ids=str)
def test_beside_all_orders_of_small_sets(ends):
    """The bound by counting holds, and the search finds the least there is."""
    compared = 0
    for q in small_sets():
        graph = MinimalLegs(q)
        near = (np.abs(q @ q.T) > 0.8).tolist()
        orders = [
            o for o in permutations(range(9)) if ends.start in (None, o[0]) and not (ends.closed and o[0])
        ]
        best = min((corners_of(o, near, graph, ends.closed) for o in orders), default=np.inf)
        order = descend(graph, ends, count_corner, 0.0)
        if best == np.inf:
            assert order is None
            continue
        corners = judged(order, q, ends.closed)[0]
        assert len(q) - 2 + ends.closed - graph.counting_bound(ends.closed) <= best
        assert corners == best
        compared += 1
    assert compared > 3


def test_too_many_are_not_searched():
    with pytest.raises(InputError) as error:
        made(about_z(301, 1), "tour: fewest-stops")
    assert str(error.value) == (
        'route.tour: "fewest-stops" is searched for 300 orientations at most, not for 301; '
        'use "shortest" or "fastest"'
    )
