"""Fewest stops and least turning: shipped tours checked without the search's code, bounds, counts."""

import json
from collections import Counter
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from timelaw.errors import InputError
from timelaw.orientations import OrientationSet, read_orientations
from timelaw.orientations.lattices import make_lattice
from timelaw.reproduce.tour_counts import count_by_straight_nodes, count_cycles, count_paths, main
from timelaw.requirements import resolve_requirements
from timelaw.requirements.route_limit import find_route_limit
from timelaw.route import lay_route
from timelaw.tours import find_tour
from timelaw.tours.graph.minimal_legs import MinimalLegs
from timelaw.tours.graph.symmetry import find_congruence
from timelaw.tours.straightest import check_minimal

SHIPPED = json.loads(files("timelaw.tours").joinpath("data/straight.json").read_text())
CASES = [
    (name, kind, goal, index)
    for name, kinds in SHIPPED.items()
    for kind, goals in kinds.items()
    for goal in ("fewest-stops", "least-turning")
    for index in range(len(goals[goal]))
]


def turns(order, q, closed):
    """By SciPy's rotations: angles [deg] of the legs, and between their axes at the inner nodes."""
    visits = [*order, order[0]] if closed else list(order)
    rotations = Rotation.from_quat(q[visits], scalar_first=True)
    vectors = (rotations[:-1].inv() * rotations[1:]).as_rotvec(degrees=True)
    angles = np.linalg.norm(vectors, axis=1)
    cosines = np.sum(vectors[:-1] * vectors[1:], axis=1) / angles[:-1] / angles[1:]
    return angles, np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def judged(order, name, closed):
    """(straight nodes, turning [deg]) of a tour that visits all vertices once by minimal legs."""
    q = make_lattice(name)
    assert sorted(order) == list(range(len(q)))
    angles, corners = turns(order, q, closed)
    np.testing.assert_allclose(
        angles, np.degrees(2 * np.arccos(np.max(np.abs(q @ q.T) - 2 * np.eye(len(q))))), rtol=1e-9
    )
    return int(np.sum(corners < 1e-4)), float(np.sum(corners))


def searched(spec):
    made = problem(f"route: {{{spec}}}")
    points = read_orientations(made.route.orientations, Path())
    return find_tour(made, points), points


# name, closed, goal: straight nodes, turning [deg]
BEST = {
    ("24-cell", False, "fewest-stops"): (5, 469.47),
    ("24-cell", True, "fewest-stops"): (6, None),
    ("24-cell", False, "least-turning"): (4, 423.17),
    ("600-cell", False, "fewest-stops"): (42, 1493.13),
    ("600-cell", True, "fewest-stops"): (42, None),
    ("600-cell", False, "least-turning"): (40, 1194.96),
    ("tesseract", False, "least-turning"): (0, 6 * 70.5288),
    ("120-cell", False, "least-turning"): (0, 298 * 70.5288),
    ("120-cell", True, "fewest-stops"): (0, 299 * 70.5288),
    ("16-cell", True, "fewest-stops"): (0, 3 * 90),
}


@pytest.mark.parametrize("case", BEST, ids=str)
def test_the_straightest_tours(case):
    name, closed, goal = case
    found, _ = searched(f"orientations: {{lattice: {name}}}, tour: {goal}, closed: {str(closed).lower()}")
    straight, turning = judged(found.order, name, closed)
    most, least = BEST[case]
    assert straight == most
    if least is not None:
        assert turning == pytest.approx(least, abs=0.01)
    merits = {merit.name: merit for merit in found.merits}
    assert merits["straight nodes"].value == straight
    assert np.degrees(merits["turning"].value) == pytest.approx(turning, abs=1e-4)
    assert merits["straight nodes"].bound >= straight
    assert np.degrees(merits["turning"].bound) <= turning + 1e-6
    assert found.is_shortest
    if goal == "fewest-stops" or name != "600-cell":
        best = merits["straight nodes" if goal == "fewest-stops" else "turning"]
        assert best.is_best


@pytest.mark.parametrize(("name", "kind", "goal", "index"), CASES)
def test_shipped_tours(name, kind, goal, index):
    order = SHIPPED[name][kind][goal][index]
    straight, _ = judged(order, name, kind == "closed")
    assert straight <= SHIPPED[name][kind]["most straight nodes"]
    if goal == "fewest-stops":
        assert straight == SHIPPED[name][kind]["most straight nodes"]


def test_the_open_tour_of_the_600_cell_is_17_runs():
    """59 legs; a run has at most four, so 16 runs or fewer would leave at most five legs unused in all."""
    found, _ = searched("orientations: {lattice: 600-cell}, tour: fewest-stops")
    _, corners = turns(found.order, make_lattice("600-cell"), False)
    lengths = np.diff([0, *(np.flatnonzero(corners > 1e-4) + 1), 59])
    assert len(lengths) == 17
    assert Counter(lengths.tolist())[4] >= 10


@pytest.mark.parametrize("start", [1, 7, 60])
@pytest.mark.parametrize("end", [None, 2, 33, 59])
def test_tours_of_the_600_cell_begin_and_end_where_they_should(start, end):
    spec = f"orientations: {{lattice: 600-cell}}, tour: fewest-stops, start: {start}"
    found, points = searched(spec + (f", end: {end}" if end else ""))
    assert points.labels[found.order[0]] == str(start)
    assert end is None or points.labels[found.order[-1]] == str(end)
    assert judged(found.order, "600-cell", False)[0] == 42


@pytest.mark.parametrize("ends", ["", ", end: 9", ", start: 7, end: 60", ", closed: true, start: 4"])
def test_a_600_cell_in_other_axes_and_another_order_has_the_same_tours(ends):
    q = make_lattice("600-cell")
    q = (Rotation.random(rng=1) * Rotation.from_quat(q, scalar_first=True) * Rotation.random(rng=2)).as_quat(
        scalar_first=True
    )
    rng = np.random.default_rng(3)
    q = (q * rng.choice([-1, 1], (60, 1)))[rng.permutation(60)]
    points = OrientationSet(q, tuple(str(i + 1) for i in range(60)), "list")
    for goal in ("fewest-stops", "least-turning"):
        made = problem(f"route: {{orientations: {{lattice: 600-cell}}, tour: {goal}{ends}}}")
        found = find_tour(made, points)
        assert sorted(found.order) == list(range(60))
        angles, corners = turns(found.order, q, made.route.closed)
        np.testing.assert_allclose(angles, 72, atol=1e-6)
        if goal == "fewest-stops":
            assert np.sum(corners < 1e-4) == 42
        assert made.route.start in (None, str(found.order[0] + 1))
        assert made.route.end in (None, str(found.order[-1] + 1))


def test_other_sets_of_sixty_are_not_taken_for_the_600_cell():
    model, rng = make_lattice("600-cell"), np.random.default_rng(5)
    other = model.copy()
    other[-1] = Rotation.random(rng=rng).as_quat(scalar_first=True)
    for points in (other, model[:-1], unit_quaternions(rng, 60), make_lattice("24-cell")):
        assert find_congruence(model, points) is None
    assert find_congruence(model, model) is not None


@pytest.mark.parametrize("digits", [4, 6, 8, 9, 10, 12])
def test_a_600_cell_written_with_few_digits_is_the_lattice_or_refused(digits):
    points = OrientationSet(
        make_lattice("600-cell").round(digits), tuple(str(i + 1) for i in range(60)), "list"
    )
    spec = problem("route: {orientations: {lattice: 600-cell}, tour: fewest-stops}")
    if digits < 10:
        with pytest.raises(InputError, match="needs a tour whose legs all have the minimal distance"):
            find_tour(spec, points)
    else:
        assert {m.name: m.value for m in find_tour(spec, points).merits}["straight nodes"] == 42


def test_end_alone_and_closed_from_a_start():
    found, points = searched("orientations: {lattice: 600-cell}, tour: fewest-stops, end: 9")
    assert points.labels[found.order[-1]] == "9"
    assert judged(found.order, "600-cell", False)[0] == 42
    closed, points = searched(
        "orientations: {lattice: 600-cell}, tour: fewest-stops, closed: true, start: 31"
    )
    assert points.labels[closed.order[0]] == "31"
    assert judged(closed.order, "600-cell", True)[0] == 42


def test_the_24_cell_between_two_given_nodes():
    found, points = searched("orientations: {lattice: 24-cell}, tour: fewest-stops, start: 3, end: 8")
    assert [points.labels[found.order[0]], points.labels[found.order[-1]]] == ["3", "8"]
    judged(found.order, "24-cell", False)
    assert {m.name: m for m in found.merits}["straight nodes"].is_best


@pytest.mark.parametrize("name", ["16-cell", "tesseract", "120-cell"])
def test_some_lattices_have_no_straight_nodes_at_all(name):
    assert not MinimalLegs(make_lattice(name)).onward


def test_the_fewest_stops_save_what_they_should():
    for name, total in (("24-cell", 26.2), ("600-cell", 82.7)):
        made = problem(f"route: {{orientations: {{lattice: {name}}}, tour: fewest-stops}}")
        points = read_orientations(made.route.orientations, Path())
        way = lay_route(points, find_tour(made, points))
        assert find_route_limit(way, resolve_requirements(made, way)) == pytest.approx(total, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda order: order[:-1], "every node once"),
        (lambda order: [*order[:-1], order[0]], "every node once"),
        (sorted, "not minimal"),
    ],
)
def test_what_is_no_such_tour_is_refused(change, message):
    graph = MinimalLegs(make_lattice("600-cell"))
    with pytest.raises(ValueError, match=message):
        check_minimal(change(SHIPPED["600-cell"]["open"]["fewest-stops"][0]), graph, closed=False)


CROSS = "orientations: {list: [[1,0,0,0], [0.96,0.28,0,0], [0.8,0.6,0,0], [0,0,1,0]]}"
STAR = "[[1,0,0,0],[0.8,0.6,0,0],[0.8,-0.3,0.519615242270663,0],[0.8,-0.3,-0.519615242270663,0]]"


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        (
            f"{CROSS}, tour: fewest-stops",
            "there are orientations with no neighbour at the minimal distance: 3, 4",
        ),
        (
            f"orientations: {{list: {STAR}}}, tour: least-turning",
            "there are orientations with one neighbour only, where all but the ends need two: 2, 3, 4",
        ),
        (
            f"orientations: {{list: {STAR}}}, tour: fewest-stops, closed: true",
            "there are orientations with one neighbour only, where a closed tour needs two: 2, 3, 4",
        ),
        (
            "orientations: {lattice: tesseract}, tour: fewest-stops, start: 1, end: 4",
            "comparing all shows that there is none",
        ),
    ],
)
def test_sets_without_a_tour_by_minimal_legs(spec, message):
    with pytest.raises(InputError) as error:
        searched(spec)
    goal = spec.split("tour: ")[1].split(",")[0]
    assert str(error.value) == (
        f'route.tour: "{goal}" needs a tour whose legs all have the minimal distance, and {message}; '
        'use "shortest" or "fastest"'
    )


@pytest.mark.campaign
def test_counts_of_the_24_cell():
    """SOURCES: 4 848 and 86 784 by table 1; 1 257 984 per node and 15 095 808 on SO(3); 384 with five straight."""
    graph = MinimalLegs(make_lattice("24-cell"))
    near = graph.neighbours
    assert count_paths(near, 0) == 1_257_984
    assert 12 * count_paths(near, 5) == 15_095_808
    table = [
        [j for j in range(12) if abs(make_lattice("24-cell")[i] @ make_lattice("24-cell")[j] - 0.5) < 1e-9]
        for i in range(12)
    ]
    assert count_paths(table, 0) == 4_848
    assert sum(count_paths(table, i) for i in range(12)) == 86_784
    straight = count_by_straight_nodes(graph, 0, closed=False)
    assert straight[5] == 384
    assert sum(straight.values()) == 1_257_984
    # of the 96 closed ones with six, node 1 is a corner of half, and straight in the others
    closed = count_by_straight_nodes(graph, 0, closed=True)
    assert closed[6] == 48
    assert sum(closed.values()) == count_cycles(near, 0)


def test_counts_of_the_tesseract_by_hand(capsys):
    """Its graph is K4,4: 8 · 4! · 4!/2 … from one node 4 · 3 · 3 · 2 · 2 · 1 · 1 = 144 paths."""
    main(["tesseract"])
    assert "on SO(3): 144 from node 1, 1152 in all; 144 closed ones" in capsys.readouterr().out
    with pytest.raises(Exception, match="give one lattice: 16-cell, tesseract, 24-cell"):
        main(["600-cell"])
