"""Tours with the fewest stops: the shipped ones checked without the search's code, and the search itself."""

import json
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.conftest import problem
from timelaw.orientations import orientations
from timelaw.orientations.lattices import lattice
from timelaw.route import route
from timelaw.schedule import schedule
from timelaw.time_law import physical_limit
from timelaw.tours import tour
from timelaw.tours.fewest_stops import check
from timelaw.tours.lines import Lines
from timelaw.tours.run_search import search

SHIPPED = json.loads(files("timelaw.tours").joinpath("data/fewest_stops.json").read_text())
CASES = [(name, kind) for name, kinds in SHIPPED.items() for kind in kinds]


def straight_nodes(order, q, closed):
    """By SciPy's rotations: the relative turns of two legs in a row are about one axis, in one sense."""
    stops = [*order, order[0]] if closed else order
    rotations = Rotation.from_quat(q[stops], scalar_first=True)
    turns = (rotations[:-1].inv() * rotations[1:]).as_rotvec()
    same = np.linalg.norm(turns[1:] - turns[:-1], axis=1) < 1e-9
    angles = np.linalg.norm(turns, axis=1)
    return int(np.sum(same)), angles


@pytest.mark.parametrize(("name", "kind"), CASES)
def test_shipped_tours_are_shortest_and_as_straight_as_they_say(name, kind):
    q, order = lattice(name), SHIPPED[name][kind]
    assert sorted(order) == list(range(len(q)))
    straight, angles = straight_nodes(order, q, kind == "closed")
    nearest = 2 * np.arccos(np.max(np.abs(q @ q.T) - 2 * np.eye(len(q))))
    np.testing.assert_allclose(angles, nearest, rtol=1e-9)
    assert straight == Lines(q).straight(tuple([*order, order[0]] if kind == "closed" else order))
    assert straight <= Lines(q).counting_bound(kind == "closed")


@pytest.mark.parametrize(("closed", "most"), [(False, 5), (True, 6)])
def test_the_24_cell_reaches_its_counting_bound(closed, most):
    """11 legs in runs of at most two are at least six runs: at most five straight nodes; closed, six of twelve."""
    lines = Lines(lattice("24-cell"))
    assert lines.counting_bound(closed) == most
    assert (
        straight_nodes(SHIPPED["24-cell"]["closed" if closed else "open"], lattice("24-cell"), closed)[0]
        == most
    )
    found = search(lines, 6, closed=closed, seed=3)
    assert found is not None
    assert straight_nodes(list(found), lattice("24-cell"), closed)[0] == most


@pytest.mark.parametrize("name", ["16-cell", "tesseract", "120-cell"])
def test_some_lattices_have_no_straight_nodes_at_all(name):
    assert not Lines(lattice(name)).onward


def laid_out(spec):
    made = problem(f"route: {{{spec}}}")
    points = orientations(made.route.orientations, Path())
    way = route(points, tour(made.route, points))
    return way, schedule(made, way)


def test_the_fewest_stops_of_the_24_cell_save_what_they_should():
    way, plan = laid_out("orientations: {lattice: 24-cell}, tour: fewest-stops")
    assert way.straight_nodes == 5
    assert physical_limit(way, plan) == pytest.approx(26.2, rel=1e-12)


def test_a_lattice_without_straight_nodes_gets_a_shortest_tour():
    one, _ = laid_out("orientations: {lattice: 120-cell}, tour: fewest-stops")
    other, _ = laid_out("orientations: {lattice: 120-cell}, tour: shortest")
    assert [n.label for n in one.nodes] == [n.label for n in other.nodes]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda order: order[:-1], "every node once"),
        (lambda order: [*order[:-1], order[0]], "every node once"),
        (sorted, "not minimal"),
    ],
)
def test_what_is_no_such_tour_is_refused(change, message):
    lines = Lines(lattice("24-cell"))
    with pytest.raises(ValueError, match=message):
        check(change(SHIPPED["24-cell"]["open"]), lines, closed=False)
