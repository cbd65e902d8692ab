"""Paths against the judge in exact arithmetic: ways of the origin, deviations, motions that go round."""

import mpmath
import numpy as np
import pytest

from tests.exact.bounds import compare, make_case
from tests.exact.broken_paths import list_broken_paths, list_tolerable_paths, make_turn, turned
from tests.exact.curves import make_curve
from tests.exact.documents import ONE
from tests.exact.judge import judge
from tests.exact.limits import list_limited
from tests.exact.motion import Motion
from tests.exact.mutations import ACCEPTED, FAILED, FOUND, REFUSED, alter, examine, verify
from tests.exact.origins import Origin
from tests.exact.path_laws import list_path_laws
from timelaw.law_file import from_document

CASES, BOUNDS_LEAST, MUTATIONS = 5, 20, 10
SLACK = 1e-9  # of bounds of which nothing cancels to less than a thousandth


@pytest.fixture(scope="module")
def broken():
    return list_broken_paths()


def test_the_judge_sees_the_one_promise_that_is_broken(broken):
    seen = [(promise, what, {reason.split()[0] for reason in judge(law)}) for promise, what, law in broken]
    assert [one for one in seen if one[2] != {one[0]}] == []
    assert {promise for promise, _, _ in broken} == {"P3", "P5", "P6", "P8"}


def test_verify_finds_what_is_broken(broken):
    assert [what for _, what, law in broken if verify(law)[0] not in (FOUND, REFUSED)] == []


def test_what_keeps_every_promise_is_accepted():
    for what, law in list_tolerable_paths().items():
        assert (what, judge(law), verify(law)) == (what, [], (ACCEPTED, []))


@pytest.mark.parametrize("beyond", [0.3, -0.3])
def test_the_exact_deviation_of_turns_that_are_known(beyond):
    """Beyond an end it is the angle to that end, aside the angle to the circle, over the end of a half-turn none."""
    over = 1.0 + beyond if beyond > 0 else beyond
    for law, angle in (
        (make_turn(ONE, turned(over), turned(1.0), bound=1.0), 0.3),
        (make_turn(ONE, turned(0.5, 0.2), turned(1.0), bound=1.0), 0.2),
        (make_turn(ONE, turned(0.5), turned(1.0), bound=1.0), 0.0),
    ):
        (found,) = (one for one in list_limited(Motion(law)) if one.label == "deviation")
        assert float(found.maximum) == pytest.approx(angle, rel=1e-13, abs=1e-15)


@pytest.mark.parametrize("end", [0, 1])
def test_the_exact_rates_of_the_origin_are_differences_of_its_place(end):
    rng = np.random.default_rng(7)
    control, points = (tuple(map(tuple, rng.normal(size=(5, n)).tolist())) for n in (4, 3))
    curve = make_curve(2.5, control, points)
    exact = Origin(curve).places_at(end)
    with mpmath.workdps(50):
        for i in range(3):
            differences = mpmath.diffs(lambda t, i=i: find_place(curve, t / 2.5)[i], 2.5 * end, 4)
            for order, difference in enumerate(differences):
                assert abs(as_number(exact[order][i]) - difference) < 1e-6 * (1 + abs(difference))


def as_number(exact):
    return mpmath.mpf(int(exact.p)) / int(exact.q)


def find_place(curve, u):
    p, q = (
        [mpmath.polyval([as_number(c) for c in part.coeffs()], u, asc=True) for part in parts]
        for parts in (curve.path, curve.parts)
    )
    return [x / sum(y * y for y in q) for x in p]


@pytest.mark.parametrize("name", ["curves and a dwell", "a joint that is passed", "near the arcs"])
def test_exact_maxima_are_those_of_samples(name):
    document = list_path_laws()[name]
    law, exact = from_document(document), {}
    for one in list_limited(Motion(document)):
        exact[one.label] = max(exact.get(one.label, 0.0), float(one.maximum))
    t = np.linspace(0, law.duration, 20001)
    for label, maximum in exact.items():
        limit, axis = label.partition(" ")[::2]
        if limit == "deviation":
            sampled = sample_deviation(law)
        elif limit.startswith("linear"):
            values = np.abs(law.place(t, 1 if limit == "linear_velocity" else 2))
            sampled = values[:, "xyz".index(axis)] if axis else np.linalg.norm(values, axis=1)
        else:
            continue
        assert maximum * (1 - 1e-3) <= np.max(sampled) <= maximum * (1 + 1e-9)


def sample_deviation(law):
    """To the nearest of many points of each arc."""
    found = []
    for segment in law.segments:
        half = np.arccos(segment.start @ segment.end)
        s = np.linspace(0, 1, 4001)[:, None]
        arc = (np.sin((1 - s) * half) * segment.start + np.sin(s * half) * segment.end) / np.sin(half)
        q = segment(np.linspace(0, 1, 501), 0, "right")
        found.append(np.max(2 * np.arccos(np.clip(np.max(np.abs(q @ arc.T), axis=1), -1, 1))))
    return np.array(found) * (1 - 1e-6)  # the nearest of many points is a little farther than the arc


def test_no_proved_bound_is_lower_than_the_exact_maximum_nor_far_above():
    compared = [one for number in range(CASES) for one in compare(make_case(21, number, "path"), number)]
    assert len(compared) >= BOUNDS_LEAST
    assert [one for one in compared if one.too_low] == []
    assert [one for one in compared if one.well_scaled and one.slack > SLACK] == []


def test_no_altered_law_is_accepted_that_breaks_a_promise():
    laws, outcomes = list_path_laws(), []
    for number in range(MUTATIONS):
        name, kind, document = alter(laws, 5, number)
        outcomes += examine(name, kind, document, laws[name])
    assert [(one.law, one.kind, one.broken) for one in outcomes if one.row in FAILED] == []
    assert {ACCEPTED, FOUND} <= {one.verdict for one in outcomes}
