"""A tour through part of a table, and one that sets out from home and returns to it."""

import numpy as np
import pytest

from tests.cases import problem
from tests.laws import angles_between
from timelaw.errors import InputError
from timelaw.orientations import read_orientations
from timelaw.pipeline import lay_out
from timelaw.tours import find_tour

HEAD = "timelaw: 1\nname: part\nlimits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"


def lay(tmp_path, route):
    (tmp_path / "p.yaml").write_text(f"{HEAD}route: {{{route}}}\n")
    return lay_out(tmp_path / "p.yaml")


def read(spec):
    return read_orientations(problem(f"route: {{orientations: {{{spec}}}}}").route.orientations, None)


def test_only_some_are_visited():
    found, whole = read("lattice: 600-cell, only: [3, 9-12, 60]"), read("lattice: 600-cell")
    assert found.labels == ("3", "9", "10", "11", "12", "60")
    np.testing.assert_array_equal(found.quaternions, whole.quaternions[[2, 8, 9, 10, 11, 59]])
    assert found.notes == ("6 of the 60 orientations of 600-cell are taken",)
    assert found.lattice is None


def test_a_tour_goes_through_the_part(tmp_path):
    layout = lay(tmp_path, "orientations: {lattice: 600-cell, only: [1-5]}, tour: [5, 4, 3, 2, 1]")
    assert [node.label for node in layout.route.nodes] == ["5", "4", "3", "2", "1"]
    searched = find_tour(
        problem("route: {orientations: {lattice: 600-cell, only: [1-5]}, tour: shortest}"),
        layout.orientations,
    )
    assert searched.is_shortest


def test_a_label_may_look_like_a_range(tmp_path):
    (tmp_path / "t.csv").write_text("label,w,x,y,z\n1-3,1,0,0,0\n3,0,1,0,0\n1,0,0,1,0\n")
    made = problem("route: {orientations: {file: t.csv, only: [1-3, 1]}}").route.orientations
    assert read_orientations(made, tmp_path).labels == ("1-3", "1")


@pytest.mark.parametrize(
    ("only", "message"),
    [
        ("[61]", '"61" is no label, nor a range of them; there are 1, 2, 3, 4, 5, 6, … (60 in all)'),
        ("[9-61]", '"9-61" is no label, nor a range'),
        ("[12-9]", '"12-9" is no label, nor a range'),
        ("[7]", "1 orientations; at least two are needed"),
        ("7", "a list of labels, or of ranges such as 9-20, is needed"),
        ("[]", "a list of labels, or of ranges such as 9-20, is needed"),
    ],
)
def test_parts_that_are_none(only, message):
    with pytest.raises(InputError, match=r"route\.orientations\.only") as error:
        read(f"lattice: 600-cell, only: {only}")
    assert message in str(error.value)


def test_the_motion_leaves_home_and_comes_back(tmp_path):
    layout = lay(tmp_path, "orientations: {lattice: 24-cell}, tour: paper, home: [0.6, 0.8, 0, 0]")
    labels = [node.label for node in layout.route.nodes]
    assert labels == ["home", "1", "12", "11", "3", "8", "10", "2", "7", "9", "6", "5", "4", "home"]
    for leg in (layout.route.legs[0].start, layout.route.legs[-1].end):
        assert angles_between(leg, [0.6, 0.8, 0, 0]) < 1e-12
    inside = 11 * 2 * np.pi / 3
    ways = angles_between(np.array([[1.0, 0, 0, 0], [0, 0, 0, 1]]), np.array([[0.6, 0.8, 0, 0]] * 2))
    assert layout.tour.length == pytest.approx(inside + float(np.sum(ways)), abs=1e-12)
    assert layout.tour.merits[0].bound <= layout.tour.length
    assert layout.tour.merits[0].bound == pytest.approx(
        inside + 2 * float(np.min(angles_between(layout.orientations.quaternions[:-1], [0.6, 0.8, 0, 0])))
    )


def test_home_that_is_a_node_is_not_visited_twice_in_a_row(tmp_path):
    layout = lay(tmp_path, "orientations: {lattice: 24-cell}, tour: paper, home: [-1, 0, 0, 0]")
    labels = [node.label for node in layout.route.nodes]
    assert labels[0] == "1"
    assert labels[-2:] == ["4", "home"]
    same = lay(tmp_path, "orientations: {list: [[1,0,0,0], [0,1,0,0], [-1,0,0,0]]}, home: [1, 0, 0, 0]")
    assert [node.label for node in same.route.nodes] == ["1", "2", "3"]


def test_rules_hold_at_home(tmp_path):
    (tmp_path / "p.yaml").write_text(
        f"{HEAD}route: {{orientations: {{lattice: 16-cell}}, home: [0.6, 0.8, 0, 0]}}\nnodes: {{at: {{home: {{dwell: 2 s}}}}}}\n"
    )
    layout = lay_out(tmp_path / "p.yaml")
    assert layout.requirements.dwells == (2.0, 0.0, 0.0, 0.0, 0.0, 2.0)


@pytest.mark.parametrize(
    ("route", "message"),
    [
        (
            "orientations: {lattice: 24-cell}, home: [1, 1, 0, 0]",
            "route.home: expected a unit quaternion [w, x, y, z]",
        ),
        (
            "orientations: {lattice: 24-cell}, home: [1, 0, 0, 0], closed: true",
            'route.home: the motion goes back home; leave "closed" away',
        ),
        (
            "orientations: {file: t.csv}, home: [0.6, 0, 0.8, 0]",
            'route.home: an orientation is called "home" already; rename it',
        ),
    ],
)
def test_homes_that_are_none(route, message, tmp_path):
    (tmp_path / "t.csv").write_text("label,w,x,y,z\nhome,1,0,0,0\nup,0,1,0,0\n")
    with pytest.raises(InputError) as error:
        lay(tmp_path, route)
    assert message in str(error.value)
