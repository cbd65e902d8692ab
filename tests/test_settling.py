"""What is straight within the precision of the input is straight; what is not keeps its corners."""

import json

import numpy as np
import pytest

from tests.typed import (
    WAYS,
    check,
    corners,
    go_on,
    lay,
    lay_if_apart,
    step,
    unit,
    write,
)
from timelaw.errors import InputError
from timelaw.numerics.quaternion import angle_between, from_axis_angle
from timelaw.numerics.turn import find_turn
from timelaw.orientations import OrientationSet
from timelaw.orientations.precision import Precision
from timelaw.pipeline import design, lay_out
from timelaw.requirements.route_limit import find_route_limit
from timelaw.route import lay_route
from timelaw.route.great_circle import GreatCircle, fit_circle
from timelaw.tours import Tour

AXIS = np.array([1.0, 2.0, 3.0]) / 14**0.5
TURN = from_axis_angle(AXIS, np.radians(5 * np.arange(7)))
EXAMPLES = (4, 5, 7, "single", "nine digits of single", "shortest single")
HEAD = "timelaw: 1\nname: typed\nlimits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"


def make(folder, rows, rest="", keys=""):
    path = folder / "typed.yaml"
    listing = f"{{list: {np.asarray(rows).tolist()}{keys}}}"
    path.write_text(f"{HEAD}route: {{orientations: {listing}}}\n{rest}")
    return path


@pytest.mark.parametrize("way", EXAMPLES)
def test_a_turn_in_seven_typed_nodes_is_one_run(way, tmp_path):
    """30° in 1.2198 s with the double-S, within what 30° is off; 3.57 s with a stop at every node."""
    layout = lay_out(make(tmp_path, write(TURN, way)))
    check(layout.orientations, layout.route)
    assert [len(run.angles) for run in layout.route.runs()] == [6]
    assert sum(layout.route.angles) == pytest.approx(
        np.radians(30), abs=2 * layout.orientations.precision.angle
    )
    limit = find_route_limit(layout.route, layout.requirements)
    assert limit == pytest.approx(1.2198, abs=1e-4)


@pytest.mark.parametrize("way", EXAMPLES)
def test_its_law_is_certified(way, tmp_path):
    done = design(make(tmp_path, write(TURN, way), "easing: {basis: polynomial, degree: 9}\n"))
    assert done.optimised.certificate.holds
    assert done.optimised.law.duration == pytest.approx(1.2272, abs=2e-4)
    assert [node.kind for node in done.optimised.certificate.continuity.nodes[1:-1]] == ["straight"] * 5


@pytest.mark.parametrize("way", EXAMPLES)
def test_a_double_s_through_typed_nodes(way, tmp_path):
    done = design(make(tmp_path, write(TURN, way), "easing: {basis: double-s}\n"))
    assert done.optimised.certificate.findings() == []
    assert done.optimised.law.duration == pytest.approx(1.2198, abs=1e-4)


@pytest.mark.parametrize("way", WAYS)
def test_chains_that_meet_at_corners_get_no_corner_more(way):
    """One to four chains of even, uneven, tiny, half-turn legs: never a corner where nothing turned."""
    for seed in range(40):
        rng = np.random.default_rng(seed)
        q, ends = [unit(rng, 4) if rng.random() < 0.5 else np.eye(4)[0]], []
        for _ in range(rng.integers(1, 5)):
            legs = rng.integers(1, 8)
            kinds = (
                np.full(legs, np.radians(5)),
                rng.uniform(0.05, 3.0, legs),
                10 ** rng.uniform(np.log10(max(12 * step(way), 1e-6)), 0.4, legs),
                np.full(legs, np.pi),
            )
            q += list(go_on(q[-1], unit(rng), kinds[rng.integers(4)]))
            ends.append(len(q) - 1)
        signs = rng.choice([-1, 1], (len(q), 1))
        _, found = lay(write(np.array(q) * signs, way))
        assert len(corners(found)) <= len(ends) - 1, f"lay(write(..., {way!r})) of seed {seed}"


@pytest.mark.parametrize("way", [3, 4, 6, "single"])
def test_closed_tours_whose_sides_are_cut_into_legs(way):
    """The first orientation is the last one, and moves with it."""
    laid = 0
    for seed in range(60):
        rng = np.random.default_rng(seed)
        ends = [unit(rng, 4) for _ in range(rng.integers(3, 6))]
        q = []
        for start, end in zip(ends, ends[1:] + ends[:1], strict=True):
            turn = find_turn(start, end)
            cuts = np.sort(rng.uniform(0.02, 0.98, rng.integers(0, 4)))
            q += [start, *go_on(start, turn.axis, np.diff(cuts * turn.angle, prepend=0.0))]
        found = lay_if_apart(write(np.array(q), way), closed=True)
        if found is not None:
            laid += 1
            assert len(corners(found)) <= len(ends) - 1
            assert abs(found.legs[0].start @ found.legs[-1].end) == pytest.approx(1, abs=1e-15)
            assert found.nodes[0].moved == found.nodes[-1].moved
    assert laid > 30


@pytest.mark.parametrize("way", [4, 6, "single"])
def test_a_ring_is_one_run(way):
    for seed in range(40):
        rng = np.random.default_rng(seed)
        count = rng.integers(2, 9)
        q = go_on(unit(rng, 4), unit(rng), np.full(count, 2 * np.pi / count))
        _, found = lay(write(q, way), closed=True)
        assert corners(found) == []
        assert sum(found.angles) == pytest.approx(2 * np.pi, abs=1e-13)


@pytest.mark.parametrize("way", [3, 4, 5, 6, 7])
def test_random_sets_keep_their_corners(way):
    for seed in range(20):
        rng = np.random.default_rng(seed)
        q = np.array([unit(rng, 4) for _ in range(12)])
        _, found = lay(write(q, way))
        assert len(corners(found)) == 10
        assert found.moved == {}


@pytest.mark.parametrize("way", [3, 4, 5, 6, 7, "single"])
def test_corners_beyond_three_times_the_precision_are_not_swallowed(way):
    """A corner whose three nodes are 3δ or more from every great circle, by its true orientations."""
    tried = 0
    for seed in range(300):
        rng = np.random.default_rng(seed)
        axis, aside = unit(rng), unit(rng)
        aside -= axis * (axis @ aside)
        angles = rng.uniform(0.02, 2.5, 2)
        turn = 10 ** rng.uniform(0.3, 2.5) * step(way)
        bent = np.cos(turn) * axis + np.sin(turn) * aside / np.linalg.norm(aside)
        start = unit(rng, 4)
        middle = go_on(start, axis, angles[:1])[0]
        q = np.array([start, middle, go_on(middle, bent, angles[1:])[0]])
        points, found = lay(write(q, way))
        if fit_circle(q, 3 * points.precision.angle) is None:
            tried += 1
            assert corners(found) == [1], f"seed {seed}"
        elif fit_circle(q, 1e-3 * points.precision.angle) is not None:
            assert corners(found) == [], f"seed {seed}"
    assert tried > 50


def test_half_a_degree_on_legs_of_five_stays_a_corner():
    for seed in range(50):
        rng = np.random.default_rng(seed)
        axis, aside = np.linalg.qr(rng.normal(size=(3, 2)))[0].T
        bent = np.cos(np.radians(0.5)) * axis + np.sin(np.radians(0.5)) * aside
        q = [unit(rng, 4)]
        q += list(go_on(q[-1], axis, np.radians([5, 5, 5])))
        q += list(go_on(q[-1], bent, np.radians([5, 5, 5])))
        assert len(corners(lay(write(np.array(q), 4))[1])) > 0


def test_half_turns_typed_with_four_digits_go_straight_on(tmp_path):
    rows = [[1, 0, 0, 0], [0.0001, 0.7071, 0.7071, 0], [-1, 0, 0, 0], [-0.0001, 0.7071, 0.7071, 0]]
    _, found = lay(np.array(rows, dtype=float))
    assert [node.kind for node in found.nodes] == ["start", "straight", "straight", "end"]
    assert np.max(found.angles) > np.pi
    assert all(leg.half_turn for leg in found.legs)
    np.testing.assert_allclose(found.legs[0].axis, [0.5**0.5, 0.5**0.5, 0], atol=2e-4)
    done = design(make(tmp_path, rows))
    assert done.optimised.certificate.holds
    assert len(done.requirements.runs(done.route)) == 1


@pytest.mark.parametrize("sense", [1, -1])
def test_half_turns_take_the_sense_of_the_leg_before_and_after(sense):
    for seed in range(40):
        rng = np.random.default_rng(seed)
        axis, start = unit(rng), unit(rng, 4)
        for angles in ([1.0, np.pi, np.pi], [np.pi, np.pi, 1.0], [np.pi, 0.5, np.pi]):
            q = go_on(start, sense * axis, [0.0, *angles])
            _, found = lay(write(q, 4))
            assert corners(found) == []
            assert found.legs[0].axis @ axis * sense > 0.99


def test_nodes_that_are_one_within_the_precision_are_refused_in_a_row():
    rows = np.array([[1, 0, 0, 0], [0.7071, 0.7071, 0, 0], [0.7071, 0.7071, 0.0001, 0], [0, 1, 0, 0]])
    with pytest.raises(InputError) as error:
        lay(rows)
    assert str(error.value) == (
        'route.tour: "2" and "3" follow each other and are the same orientation '
        "within their precision (quaternions with 4 digits: 0.0115°); leave one out, or add duplicates: merge to the orientations"
    )


def test_exact_orientations_do_not_move():
    """Not by a bit, and their corners of any size stay corners."""
    for seed in range(30):
        rng = np.random.default_rng(seed)
        q = go_on(unit(rng, 4), unit(rng), rng.uniform(0.01, 1.5, 6))
        q /= np.linalg.norm(q, axis=1, keepdims=True)
        points, found = lay(q)
        assert corners(found) == []
        assert found.moved == {}
        np.testing.assert_array_equal(
            np.abs([leg.start for leg in found.legs]), np.abs(points.quaternions[:-1])
        )
        bent = np.vstack([q, go_on(q[-1], found.legs[-1].axis + 1e-10 * unit(rng), [0.5])])
        assert corners(lay(bent / np.linalg.norm(bent, axis=1, keepdims=True))[1]) == [5]


def test_chains_left_and_right_of_a_shared_node_move_it_only_where_they_must():
    """Where both circles through the shared nodes as typed are near enough, these stay."""
    kept = 0
    for seed in range(40):
        rng = np.random.default_rng(seed)
        q = [unit(rng, 4)]
        for _ in range(2):
            q += list(go_on(q[-1], unit(rng), np.full(3, 0.4)))
        _, found = lay(write(np.array(q), 4))
        assert corners(found) == [3]
        assert max(node.moved for node in found.nodes) > 0
        kept += found.nodes[3].moved == 0
    assert kept > 20


def test_a_precision_that_is_given_counts_instead_of_the_digits(tmp_path):
    """Angles typed in whole degrees about an axis that they only nearly keep."""
    rows = [[0, 0, 0], [1, 2, 3.01], [2, 4.01, 6], [3, 6, 9]]
    keys = ", as: rotation-vector, unit: deg"
    plain = lay_out(make(tmp_path, rows, keys=keys)).route
    assert plain.straight_nodes == 0
    given = lay_out(make(tmp_path, rows, keys=f"{keys}, precision: 0.01 deg"))
    assert given.route.straight_nodes == 2
    check(given.orientations, given.route)


def test_the_circle_of_least_largest_distance_is_found():
    """Against the closed form of three nodes: sin B q1 - sin(A + B) q2 + sin A q3 over the sum of the sines."""
    for seed in range(100):
        rng = np.random.default_rng(seed)
        a, b = rng.uniform(0.1, 1.4, 2)
        circle = GreatCircle(*np.linalg.qr(rng.normal(size=(4, 2)))[0].T)
        q = np.array([np.cos(t) * circle.u + np.sin(t) * circle.v for t in (0, a, a + b)])
        q = q + 1e-5 * rng.normal(size=q.shape)
        q /= np.linalg.norm(q, axis=1, keepdims=True)
        a, b = (angle_between(q[:-1], q[1:]) / 2).tolist()
        rest = np.sin(b) * q[0] - np.sin(a + b) * q[1] + np.sin(a) * q[2]
        least = 2 * np.linalg.norm(rest) / (np.sin(a) + np.sin(b) + abs(np.sin(a + b)))
        assert fit_circle(q, 1.02 * least) is not None
        assert fit_circle(q, 0.99 * least) is None


def test_moves_are_told_in_the_tour_and_the_report(tmp_path, capsys):
    from timelaw.cli.tour import run
    from timelaw.orientations import read_orientations
    from timelaw.problem import load_problem
    from timelaw.report import render_report

    path = make(tmp_path, write(TURN, 4))
    table = tmp_path / "tour.csv"
    assert run(str(path), str(table), table=False, as_json=True) == 0
    out = capsys.readouterr()
    told = json.loads(out.out)
    sentence = told["notes"][0]
    assert sentence.startswith(
        "7 of 7 nodes are moved onto great circles that they lie on within the precision of the input "
        "(quaternions with 4 digits: 0.0115°), so that the body goes straight on, node "
    )
    assert "".join(sentence.split()) in "".join(out.err.split())
    assert set(told["moved"]) == set("1234567")
    assert (
        0
        < max(told["moved"].values())
        <= told["precision"]["angle"]
        == pytest.approx(np.degrees(2e-4), rel=2e-4)
    )
    report = render_report(design(path), "sha256:0")["report.html"]
    assert sentence[:60] in report
    assert "moved [deg]" in report
    again = tmp_path / "again.yaml"
    again.write_text(f"{HEAD}route: {{orientations: {{file: {table.name}}}}}\n")
    problem, _ = load_problem(again)
    points = read_orientations(problem.route.orientations, tmp_path)
    assert points.precision.origin.startswith("exact")
    assert lay_out(again).route.straight_nodes == 5


def test_nothing_is_told_where_nothing_moved(tmp_path):
    from timelaw.report import render_report
    from timelaw.report.tour_text import list_notes

    done = design(make(tmp_path, TURN))
    assert list_notes(done.orientations, done.route) == []
    assert "moved" not in render_report(done, "sha256:0")["report.html"]


@pytest.mark.parametrize(("room", "kinds"), [(1.05, 2), (1.2, 1)])
def test_where_chains_together_ask_too_much_one_is_cut(room, kinds):
    """Two bows of three nodes, each straight by itself within little more than the least: they share one.

    With 1.05 times the least there is no place for it, and one bow is cut; with 1.2 times there is.
    """
    start, x, y = np.eye(4)[0], np.array([1.0, 0, 0]), np.array([0, 1.0, 0])
    q = [start]
    for one, other in ((x, y), (y, x)):
        q += list(go_on(q[-1], one, [0.3]))
        q += list(go_on(q[-1], one * np.cos(0.02) + other * np.sin(0.02), [0.3]))
    q = np.array(q)
    least = max(_least(q[:3]), _least(q[2:]))
    points = OrientationSet(q, tuple("abcde"), "list", precision=Precision(room * least, "as given"))
    found = lay_route(points, Tour(tuple(range(5)), False, 0.0, 0.0, ()))
    check(points, found)
    assert 2 in corners(found)
    assert len(corners(found)) == kinds


def _least(q):
    """The largest distance from the nearest circle, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (low, middle) if fit_circle(q, middle) is not None else (middle, high)
    return high


@pytest.mark.parametrize("seed", range(5))
def test_exact_steps_of_any_size_about_any_axis_are_straight(seed):
    """Also where the plane's two singular values are nearly equal, as for steps of 120°."""
    rng = np.random.default_rng(seed)
    for _ in range(200):
        step = (
            float(rng.choice([2 * np.pi / 3, np.pi / 2, rng.uniform(1e-3, 3.0)])) + rng.uniform(-1, 1) * 1e-3
        )
        axis = rng.normal(size=3)
        angles = [0.0, *[step] * rng.integers(2, 5)]
        q = go_on(np.array([1.0, 0, 0, 0]), axis / np.linalg.norm(axis), angles)
        _, found = lay(q)
        assert corners(found) == []
