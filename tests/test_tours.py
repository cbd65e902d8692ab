"""Tours: Hamiltonian, minimal legs, deterministic; the certificate checked without the search's code."""

from itertools import pairwise
from math import acos, degrees
from pathlib import Path

import numpy as np
import pytest

from tests.cases import problem
from timelaw.errors import InputError
from timelaw.orientations import read_orientations
from timelaw.tours import find_tour

MINIMAL = {"16-cell": 180, "tesseract": 120, "24-cell": 120, "600-cell": 72, "120-cell": 31.044975628140147}


def make(route: str):
    spec = problem(f"route: {{{route}}}")
    points = read_orientations(spec.route.orientations, Path())
    return find_tour(spec, points), points.quaternions


def leg_angles(visits, q):
    return [degrees(2 * acos(min(1.0, abs(float(q[a] @ q[b]))))) for a, b in pairwise(visits)]


@pytest.mark.parametrize("closed", ["false", "true"])
@pytest.mark.parametrize("name", MINIMAL)
def test_shortest_tours_visit_all_once_by_minimal_legs(name, closed):
    found, q = make(f"orientations: {{lattice: {name}}}, tour: shortest, closed: {closed}")
    assert sorted(found.order) == list(range(len(q)))
    assert found.order[0] == 0
    np.testing.assert_allclose(leg_angles(found.visits(), q), MINIMAL[name], atol=1e-6)
    assert found.is_shortest
    assert np.degrees(found.length) == pytest.approx(found.legs * MINIMAL[name], rel=1e-12)
    assert (
        found.order == make(f"orientations: {{lattice: {name}}}, tour: shortest, closed: {closed}")[0].order
    )


def test_the_papers_tour_is_a_shortest_one():
    found, q = make("orientations: {lattice: 24-cell}, tour: paper")
    assert [i + 1 for i in found.order] == [1, 12, 11, 3, 8, 10, 2, 7, 9, 6, 5, 4]
    np.testing.assert_allclose(leg_angles(found.order, q), 120, atol=1e-12)
    assert found.is_shortest


def test_a_tour_with_one_longer_leg_is_not_called_shortest():
    found, q = make("orientations: {lattice: 24-cell}, tour: [1, 2, 12, 11, 3, 8, 10, 7, 9, 6, 5, 4]")
    assert max(leg_angles(found.order, q)) == pytest.approx(180)
    assert not found.is_shortest


LIST = "orientations: {list: [[1,0,0,0], [0,1,0,0], [0,0,1,0]]}"


def test_given_and_labels_and_closed():
    assert make(f"{LIST}, tour: given")[0].order == (0, 1, 2)
    closed = make(f"{LIST}, tour: [3, 1, 2], closed: true")[0]
    assert closed.order == (2, 0, 1)
    assert closed.visits() == (2, 0, 1, 2)
    assert closed.legs == 3


@pytest.mark.parametrize(
    ("route", "message"),
    [
        (f"{LIST}, tour: [1, 2, 4]", 'no orientation is called "4"; there are 1, 2, 3'),
        (
            f"{LIST}, tour: [1, 2, 2, 3]",
            'the tour visits "2" twice in a row',
        ),
        (
            f"{LIST}, tour: [1, 2, 3, 1], closed: true",
            'the tour visits "1" twice in a row; with closed: true the first one is not repeated',
        ),
        (
            f"{LIST}, tour: [1, 3]",
            'the tour leaves out 2; every orientation must be visited; "only" takes part of them',
        ),
        (
            f"{LIST}, tour: paper",
            '"paper" is the tour of the lattice 24-cell, not of list; '
            "use given, shortest or a list of labels",
        ),
        (
            "orientations: {lattice: 600-cell}, tour: [1, 2]",
            'the tour leaves out 3, 4, 5, 6, 7, 8, … (58 in all); every orientation must be visited; "only" takes part of them',
        ),
    ],
)
def test_impossible_demands(route, message):
    with pytest.raises(InputError) as error:
        make(route)
    assert str(error.value) == f"route.tour: {message}"
