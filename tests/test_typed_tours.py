"""Tours of lattices that were turned and typed: as straight as those of the exact ones."""

import numpy as np
import pytest

from tests.cases import problem
from tests.typed import check, go_on, read_rows, unit, write
from timelaw.numerics.quaternion import multiply
from timelaw.numerics.turn import SAME_AXIS, allow_turn, angle_between_axes, find_turn
from timelaw.orientations.lattices import make_lattice
from timelaw.route import lay_route
from timelaw.route.great_circle import fit_circle
from timelaw.tours import find_tour
from timelaw.tours.graph.distances import list_neighbours
from timelaw.tours.graph.straight_runs import StraightRuns


def turned(name, seed=5):
    rng = np.random.default_rng(seed)
    return multiply(multiply(unit(rng, 4), make_lattice(name)), unit(rng, 4))


def lay(rows, tour):
    points = read_rows(rows)
    spec = problem(f"route: {{orientations: {{lattice: 24-cell}}, tour: {tour}}}")
    found = find_tour(spec, points)
    way = lay_route(points, found)
    check(points, way)
    return found, way


RUNS = {
    ("24-cell", "fewest-stops"): 6,
    ("24-cell", "least-turning"): 7,
    ("24-cell", "fastest"): 6,
    ("600-cell", "fewest-stops"): 17,
    ("600-cell", "least-turning"): 19,
}


@pytest.mark.parametrize("way", [4, 6, "single"])
@pytest.mark.parametrize(("name", "tour"), RUNS)
def test_typed_lattices_have_the_runs_of_exact_ones(name, tour, way):
    found, route = lay(write(turned(name), way), tour)
    assert len(route.runs()) == RUNS[name, tour]
    assert route.straight_nodes == len(route.legs) - RUNS[name, tour]
    if tour != "fastest":
        straight = next(merit for merit in found.merits if merit.name == "straight nodes")
        assert straight.value == route.straight_nodes


def test_the_shortest_tour_of_a_typed_lattice_has_minimal_legs():
    for name in ("24-cell", "600-cell", "120-cell"):
        exact = lay(turned(name), "shortest")[0]
        found = lay(write(turned(name), 4), "shortest")[0]
        assert found.length == pytest.approx(exact.length, rel=1e-4)
        assert found.merits[0].gap < 3e-3


@pytest.mark.parametrize("name", ["16-cell", "24-cell", "600-cell", "120-cell"])
def test_neighbours_of_typed_lattices_are_those_of_exact_ones(name):
    exact = list_neighbours(turned(name))
    points = read_rows(write(turned(name), 4))
    assert list_neighbours(points.quaternions, points.precision.angle) == exact


@pytest.mark.parametrize("name", ["24-cell", "600-cell"])
def test_straight_runs_of_typed_lattices_are_those_of_exact_ones(name):
    exact = turned(name)
    points = read_rows(write(exact, 4))
    passable = range(len(exact))
    typed = StraightRuns(points.quaternions, passable, points.precision.angle)
    assert set(typed.legs()) == set(StraightRuns(exact, passable).legs())
    assert set(StraightRuns(points.quaternions, passable).legs()) != set(typed.legs())


def test_the_turn_that_counts_for_none_is_that_of_three_nodes_on_a_circle():
    for seed in range(200):
        rng = np.random.default_rng(seed)
        q = np.array([unit(rng, 4)])
        first, second = rng.uniform(0.05, 3.0, 2)
        axis, aside = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
        turn = 10 ** rng.uniform(-5, -3)
        q = np.vstack([q, go_on(q[0], axis, [first])])
        q = np.vstack([q, go_on(q[1], np.cos(turn) * axis + np.sin(turn) * aside, [second])])
        before, after = find_turn(q[0], q[1]), find_turn(q[1], q[2])
        assert angle_between_axes(before.axis, after.axis) == pytest.approx(turn, rel=1e-6)
        for precision in (turn / 30, turn / 3, turn):
            if turn <= float(allow_turn(first, second, precision)):
                assert fit_circle(q, 1.03 * precision) is not None
            else:
                assert fit_circle(q, 0.99 * precision) is None
    assert float(allow_turn(1.0, 2.0, 0.0)) == SAME_AXIS
