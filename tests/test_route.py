"""Routes: legs, axes, corners and straight nodes, runs; q and -q, half-turns and tiny turns."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from timelaw.errors import InputError
from timelaw.orientations import OrientationSet, read_orientations
from timelaw.route import lay_route
from timelaw.tours import Tour, find_tour


def through(quaternions):
    """The route along a list of exact orientations."""
    q = np.array(quaternions, dtype=float)
    labels = tuple(str(i + 1) for i in range(len(q)))
    return lay_route(OrientationSet(q, labels, "list"), Tour(tuple(range(len(q))), False, 0.0, 0.0, ()))


def lattice_route(spec: str):
    model = problem(f"route: {{{spec}}}")
    points = read_orientations(model.route.orientations, Path())
    return lay_route(points, find_tour(model, points))


def about(axis, degrees):
    return Rotation.from_rotvec(np.radians(degrees) * np.array(axis)).as_quat(scalar_first=True)


def test_the_papers_route():
    """Straight at 11, 8, 7; the axis turns by 70.53° or 109.47° elsewhere; every leg is 120°."""
    way = lattice_route("orientations: {lattice: 24-cell}, tour: paper")
    np.testing.assert_allclose(way.angles, 2 * np.pi / 3, rtol=1e-15)
    assert [node.label for node in way.nodes if node.kind == "straight"] == ["11", "8", "7"]
    turns = {round(float(np.degrees(node.turn)), 2) for node in way.nodes if node.kind == "corner"}
    assert turns == {70.53, 109.47}
    assert [len(run.angles) for run in way.runs()] == [1, 2, 2, 1, 2, 1, 1, 1]
    axes = np.abs([leg.axis for leg in way.legs])
    np.testing.assert_allclose(axes, 1 / 3**0.5, atol=1e-15)


@pytest.mark.parametrize("name", ["16-cell", "tesseract", "120-cell"])
def test_lattices_without_straight_nodes(name):
    assert lattice_route(f"orientations: {{lattice: {name}}}, tour: shortest").straight_nodes == 0


@given(st.integers(0, 2**32 - 1), st.integers(2, 6))
def test_legs_lead_from_each_orientation_to_the_next_the_short_way(seed, count):
    rng = np.random.default_rng(seed)
    q = unit_quaternions(rng, count) * rng.choice([-1, 1], size=(count, 1))
    way = through(q)
    for k, leg in enumerate(way.legs):
        ends = leg.orientation(np.array([0.0, 1.0]))
        np.testing.assert_allclose(ends, [leg.start, leg.end], atol=1e-15)
        np.testing.assert_allclose(np.abs(ends @ q[k : k + 2].T).diagonal(), 1, atol=1e-15)
        relative = Rotation.from_quat(q[k], scalar_first=True).inv() * Rotation.from_quat(
            q[k + 1], scalar_first=True
        )
        assert leg.angle == pytest.approx(relative.magnitude(), abs=1e-12)
        np.testing.assert_allclose(leg.axis * leg.angle, relative.as_rotvec(), atol=1e-9)
    for before, after in zip(way.legs, way.legs[1:], strict=False):
        np.testing.assert_array_equal(before.end, after.start)


@given(st.integers(0, 2**32 - 1))
def test_signs_of_the_given_quaternions_change_nothing(seed):
    rng = np.random.default_rng(seed)
    q = unit_quaternions(rng, 4)
    plain, flipped = through(q), through(q * np.array([[1], [-1], [-1], [1]]))
    for a, b in zip(plain.legs, flipped.legs, strict=True):
        np.testing.assert_allclose(a.axis, b.axis, atol=1e-12)
        assert a.angle == pytest.approx(b.angle, abs=1e-15)


@pytest.mark.parametrize("degrees", [1e-4, 1e-2, 1.0, 179.0, 179.9999, 179.999999])
def test_turns_near_nothing_and_near_half_a_turn(degrees):
    axis = np.array([2.0, 3.0, -6.0]) / 7
    leg = through([[1, 0, 0, 0], about(axis, degrees)]).legs[0]
    assert np.degrees(leg.angle) == pytest.approx(degrees, rel=1e-9)
    np.testing.assert_allclose(leg.axis, axis, atol=1e-9)
    assert not leg.half_turn


def test_half_turns_have_one_documented_sense():
    """Of n and -n the one whose first non-zero component is positive, whatever signs are given."""
    for sign in (1, -1):
        leg = through([[1, 0, 0, 0], sign * about([0, -1, 0], 180)]).legs[0]
        assert leg.half_turn
        np.testing.assert_allclose(leg.axis, [0, 1, 0], atol=1e-15)


def test_half_turns_go_straight_on_where_they_can():
    back = [0, 0, -1]
    after = through([[1, 0, 0, 0], about(back, 60), about(back, 240)])
    assert after.nodes[1].kind == "straight"
    np.testing.assert_allclose(after.legs[1].axis, back, atol=1e-12)
    before = through([[1, 0, 0, 0], about(back, 180), about(back, 240)])
    assert before.nodes[1].kind == "straight"
    np.testing.assert_allclose(before.legs[0].axis, back, atol=1e-12)


def test_going_back_along_the_same_circle_is_a_corner():
    way = through([[1, 0, 0, 0], about([1, 0, 0], 60), about([1, 0, 0], 20)])
    assert way.nodes[1].kind == "corner"
    assert np.degrees(way.nodes[1].turn) == pytest.approx(180)


def test_the_route_parameter():
    way = lattice_route("orientations: {lattice: 24-cell}, tour: paper")
    ends = [way.legs[0].start, way.legs[0].end, way.legs[-1].end]
    np.testing.assert_allclose(way.orientation([0, 1, 11]), ends, atol=1e-15)
    middle = way.orientation(0.5)
    assert middle @ way.legs[0].start == pytest.approx(np.cos(np.pi / 6))
    with pytest.raises(ValueError, match="outside"):
        way.orientation(11.001)


@pytest.mark.parametrize("sign", [1, -1])
def test_the_same_orientation_twice_in_a_row_is_refused(sign):
    with pytest.raises(InputError, match='"1" and "2" follow each other and are the same orientation'):
        through([[1, 0, 0, 0], [sign * 1, 0, 0, 0], [0, 1, 0, 0]])


def test_half_turns_in_a_row_get_the_sense_that_goes_straight_on():
    x = [1, 0, 0]
    way = through([[1, 0, 0, 0], about(x, 180), about(x, 360), about(x, 300)])
    assert [node.kind for node in way.nodes] == ["start", "straight", "straight", "end"]
    np.testing.assert_allclose([leg.axis for leg in way.legs], [[-1, 0, 0]] * 3, atol=1e-12)


@pytest.mark.parametrize("gap", [3e-10, 9e-10])
def test_a_reversed_half_turn_still_meets_its_node(gap):
    turn = np.degrees(2 * gap)
    x = [1, 0, 0]
    way = through([[1, 0, 0, 0], about(x, -(180 - turn)), about(x, -(180 - turn) + 60)])
    for leg in way.legs:
        np.testing.assert_allclose(np.abs(leg.orientation(np.array(1.0)) @ leg.end), 1, atol=1e-15)
        assert np.linalg.norm(leg.orientation(np.array(1.0)) - leg.end) < 1e-14
