"""Rational segments against the judge in exact arithmetic: promises one by one, bounds, altered laws."""

import numpy as np
import pytest

from tests.exact.bounds import compare, make_case
from tests.exact.broken_curves import list_broken_curves, list_tolerable_curves
from tests.exact.curve_laws import list_curve_laws
from tests.exact.judge import judge
from tests.exact.limits import list_limited
from tests.exact.motion import Motion
from tests.exact.mutations import ACCEPTED, FAILED, FOUND, REFUSED, alter, examine, verify
from tests.test_rational import measure
from timelaw.certificate import certify
from timelaw.law_file import from_document

CASES, BOUNDS_LEAST = 4, 30
SEGMENTS = 1000
SLACK = 1e-9  # of bounds of which nothing cancels to less than a thousandth
MUTATIONS = 12


@pytest.fixture(scope="module")
def broken():
    return list_broken_curves()


def test_the_judge_sees_the_one_promise_that_is_broken(broken):
    seen = [(promise, what, {reason.split()[0] for reason in judge(law)}) for promise, what, law in broken]
    assert [one for one in seen if one[2] != {one[0]}] == []
    assert {promise for promise, _, _ in broken} == {"P1", "P2", "P3", "P4", "P5", "P6", "P8"}


def test_verify_finds_what_is_broken(broken):
    assert [what for _, what, law in broken if verify(law)[0] not in (FOUND, REFUSED)] == []


def test_what_keeps_every_promise_is_accepted():
    for what, law in list_tolerable_curves().items():
        assert (what, judge(law), verify(law)) == (what, [], (ACCEPTED, []))


@pytest.mark.parametrize("nearest", [1e-1, 1e-4, 1e-9])
def test_the_exact_maximum_of_a_turn_past_zero(nearest):
    """Q = (1 - 2u, nearest, 0, 0) in a second: ω = 4 nearest/((1 - 2u)² + nearest²), its derivative's largest
    value is that of 1/(1 + x²): 3√3/8."""
    document = pass_zero(nearest)
    found = {one.label: float(one.maximum) for one in list_limited(Motion(document))}
    assert found["velocity"] == pytest.approx(4 / nearest, rel=1e-15)
    assert found["acceleration"] == pytest.approx(8 / nearest**2 * 3**1.5 / 8, rel=1e-15)


def pass_zero(nearest):
    document = list_tolerable_curves()["a curve"]
    control = [[1.0, nearest, 0.0, 0.0], [-1.0, nearest, 0.0, 0.0]]
    document["segments"][0]["pieces"] = [{"duration": 1.0, "control": control}]
    return document


@pytest.mark.parametrize(
    "name", ["torque of curves", "wheels on curves", "a smooth curve", "arcs and curves"]
)
def test_exact_maxima_are_those_of_the_sampled_vectors(name):
    """Torque by Euler's equation and momentum in vectors, as the package evaluates the motion."""
    document = list_curve_laws()[name]
    law, motion = from_document(document), Motion(document)
    exact = {}
    for one in list_limited(motion):
        exact[one.label] = max(exact.get(one.label, 0.0), float(one.maximum))
    t = np.linspace(0, law.duration, 20001)
    for label, maximum in exact.items():
        limit, axis = label.partition(" ")[::2]
        values = np.abs(measure(law, limit, t))
        sampled = values[:, "xyz".index(axis)] if axis else np.linalg.norm(values, axis=1)
        assert maximum * (1 - 1e-3) <= np.max(sampled) <= maximum * (1 + 1e-12)


def test_no_proved_bound_is_lower_than_the_exact_maximum_nor_far_above():
    compared = [one for number in range(CASES) for one in compare(make_case(11, number, "rational"), number)]
    assert len(compared) >= BOUNDS_LEAST
    assert [one for one in compared if one.too_low] == []
    assert [one for one in compared if one.well_scaled and one.slack > SLACK] == []


@pytest.mark.campaign
def test_a_thousand_rational_segments():
    compared = [
        one for number in range(SEGMENTS) for one in compare(make_case(12, number, "rational"), number)
    ]
    assert [one for one in compared if one.too_low] == []
    assert [one for one in compared if one.well_scaled and one.slack > SLACK] == []


@pytest.mark.parametrize(
    "name", sorted({"curves", "torque of curves", "wheels on curves", "arcs and curves"})
)
def test_limits_are_told_from_both_sides(name):
    """Where the limit is a billionth above the exact maximum it holds; a billionth below, it does not."""
    law = {
        key: value for key, value in list_curve_laws()[name].items() if key not in ("certificate", "nodes")
    }
    exact = {}
    for one in list_limited(Motion(law)):
        exact[one.label] = max(exact.get(one.label, 0.0), float(one.maximum))
    for label, maximum in exact.items():
        limit, axis = label.partition(" ")[::2]
        for factor, holds in ((1 + 1e-9, True), (1 - 1e-9, False)):
            bound = law["limits"][limit]
            if axis:
                bound = [maximum * factor if axis == a else b * 2 for a, b in zip("xyz", bound, strict=True)]
            touched = law | {"limits": law["limits"] | {limit: bound if axis else maximum * factor}}
            assert certify(from_document(touched)).holds is holds


def test_no_altered_law_is_accepted_that_breaks_a_promise():
    laws, outcomes = list_curve_laws(), []
    for number in range(MUTATIONS):
        name, kind, document = alter(laws, 3, number)
        outcomes += examine(name, kind, document, laws[name])
    assert [(one.law, one.kind, one.broken) for one in outcomes if one.row in FAILED] == []
    assert {ACCEPTED, FOUND} <= {one.verdict for one in outcomes}
