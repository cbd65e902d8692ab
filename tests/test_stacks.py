"""Polynomials in stacks beside single ones and exact fractions; segments proved together beside each alone."""

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise
from math import comb
from types import SimpleNamespace

import numpy as np
import pytest

from tests.exact.documents import arc, document, piece
from tests.test_rational import make_curve, make_law
from timelaw.law_file import from_document
from timelaw.limits import make_limits
from timelaw.motion.curve_form import CurveForm
from timelaw.motion.quaternion_curve import HIGHEST, TOGETHER, stack_curves
from timelaw.motion.rational_quantities import list_quantities
from timelaw.numerics.ball import Ball
from timelaw.numerics.function import enclose_peaks
from timelaw.numerics.polynomial import Polynomial, PolynomialStack

BODY = {"inertia": [[12.0, 0.5, -1.0], [0.5, 10.0, 0.3], [-1.0, 0.3, 8.0]]}
WHEELS = BODY | {"actuator": "wheels", "momentum": [0.3, -0.2, 0.5]}


def draw(rng, degree, count=5):
    control = rng.normal(size=(count, degree + 1)) * 10 ** rng.uniform(-3, 3, (count, 1))
    return PolynomialStack(control, np.max(np.abs(control), axis=1) * 10 ** rng.uniform(-17, -12, count))


def check_alike(stack, singles, more=1e-12):
    """Within what both say of their rounding, which they say alike."""
    assert len(stack.control) == len(singles)
    for row, single in zip(stack.list_rows(), singles, strict=True):
        assert row.control.shape == single.control.shape
        assert np.max(np.abs(row.control - single.control)) <= row.error + single.error
        assert row.error == pytest.approx(single.error, rel=more, abs=1e-300)


OPERATIONS = {
    "a sum": lambda a, b: a + b,
    "a product": lambda a, b: a * b,
    "a square": lambda a, _: a * a,
    "a number more": lambda a, _: 1.5 + a,
    "a multiple": lambda a, _: -0.3 * a,
    "a multiple by a ball": lambda a, _: Ball(0.7, 1e-9) * a,
    "a form of higher degree": lambda a, _: a.raised(a.degree + 3),
}


@pytest.mark.parametrize("name", OPERATIONS)
@pytest.mark.parametrize(("m", "n"), [(0, 4), (6, 6), (11, 5), (3, 12)])
def test_operations_are_those_of_single_polynomials(name, m, n):
    rng = np.random.default_rng(m)
    a, b = draw(rng, m), draw(rng, n)
    singles = [OPERATIONS[name](p, q) for p, q in zip(a.list_rows(), b.list_rows(), strict=True)]
    check_alike(OPERATIONS[name](a, b), singles)


@pytest.mark.parametrize("degree", [0, 1, 6])
def test_halves_derivatives_and_multiples_row_by_row(degree):
    rng = np.random.default_rng(degree)
    a, factors = draw(rng, degree), rng.normal(size=5)
    check_alike(a.halve(), [half for p in a.list_rows() for half in p.halve()])
    check_alike(a * factors, [p * float(f) for p, f in zip(a.list_rows(), factors, strict=True)])
    if degree:
        check_alike(a.derive(), [p.derive(1.0) for p in a.list_rows()])
    else:
        assert not np.any(a.derive().control)


@pytest.mark.parametrize(("m", "n"), [(1, 1), (6, 5), (12, 30)])
def test_the_exact_product_is_within_the_rounding_that_is_carried(m, n):
    rng = np.random.default_rng(n)
    a, b = (replace(draw(rng, degree), error=np.zeros(5)) for degree in (m, n))
    product = a * b
    for p, q, found, error in zip(a.control, b.control, product.control, product.error, strict=True):
        for k, c in enumerate(found):
            terms = [
                Fraction(float(p[i])) * Fraction(float(q[k - i])) * comb(m, i) * comb(n, k - i)
                for i in range(max(0, k - n), min(m, k) + 1)
            ]
            exact = sum(terms) / comb(m + n, k)
            assert abs(exact - Fraction(float(c))) <= Fraction(float(error))


def stand_alone(stack, row):
    """The form of one piece in single polynomials."""
    parts = [Polynomial(column) for column in stack.control[row].T]
    derivatives = [parts]
    for _ in range(HIGHEST):
        parts = [part.derive(1.0) for part in parts]
        derivatives.append(parts)
    return CurveForm(None, float(stack.duration[row]), 0.0, 1.0, tuple(derivatives))


@pytest.mark.parametrize("degree", [1, 3, 6])
def test_numerators_are_those_of_single_pieces(degree):
    rng = np.random.default_rng(degree)
    (stack,) = stack_curves([make_curve(rng, degree) for _ in range(4)])
    alone = [stand_alone(stack, row) for row in range(4)]
    total = [Ball(0.3, 1e-16), Ball(-0.2, 1e-16), Ball(0.5, 1e-16)]
    for k, vector in stack.form.numerators(4).items():
        for axis, component in enumerate(vector):
            check_alike(component, [form.numerators(4)[k][axis] for form in alone])
    for axis, component in enumerate(stack.form.turn_back(total)):
        check_alike(component, [form.turn_back(total)[axis] for form in alone])
    check_alike(stack.form.power(5), [form.power(5) for form in alone])


def test_pieces_are_stacked_by_degree_and_not_too_many_together():
    rng = np.random.default_rng(5)
    curves = [make_curve(rng, 1 + k % 2) for k in range(2 * TOGETHER + 6)]
    stacks = list(stack_curves(curves))
    assert [len(s.piece) for s in stacks] == [TOGETHER, 3, TOGETHER, 3]
    assert sorted(k for s in stacks for k in s.piece.tolist()) == list(range(len(curves)))
    assert all(s.duration[row] == curves[k].duration for s in stacks for row, k in enumerate(s.piece))


def make_many(limits, body):
    """Segments of several degrees and pieces, some with limits of their own, one past where D is small."""
    rng, law = np.random.default_rng(7), make_law(limits=limits) | {"body": body, "continuity": 0}
    segments, time = [], 0.0
    for k in range(9):
        curves = [make_curve(rng, 2 + (k + p) % 4, step=0.3) for p in range(1 + k % 3)]
        if k == 4:
            curves = [
                SimpleNamespace(duration=2.0, control=np.linspace([1, 0.05, 0, 0], [-1, 0.05, 0, 0], 5))
            ]
        pieces = [{"duration": c.duration, "control": c.control.tolist()} for c in curves]
        duration = sum(c.duration for c in curves)
        own = {"velocity": 3.0 + k, "jerk": [5.0, 6.0, 7.0 + k]} if k % 2 else {}
        segments.append(
            law["segments"][0]
            | {"from": str(k), "to": str(k + 1), "start_time": time, "duration": duration}
            | {"pieces": pieces, "limits": own}
        )
        time += duration
    return from_document(law | {"segments": segments, "duration": time})


@pytest.mark.parametrize("limits", [{"velocity": 1.0, "snap": 10.0}, {"torque": [9.0] * 3, "momentum": 9.0}])
@pytest.mark.parametrize("body", [BODY, WHEELS])
def test_quantities_of_all_segments_are_those_of_each_alone(limits, body):
    law = make_many(limits, body)
    general = make_limits(law.limits, law.body)
    for own in ([general] * 9, [make_limits(s.limits, law.body) for s in law.segments]):
        found = list_quantities(law.segments, own, law.total_momentum)
        for segment, limited, together in zip(law.segments, own, found, strict=True):
            (alone,) = list_quantities([segment], [limited], law.total_momentum)
            for one, other in zip(together, alone, strict=True):
                assert (one.row, one.start, one.end) == (other.row, other.start, other.end)
                for many, few in ((one.value.num, other.value.num), (one.value.den, other.value.den)):
                    assert np.max(np.abs(many.control - few.control)) <= many.error + few.error
                    assert many.error == pytest.approx(few.error, rel=1e-12)
    bounds = {label: peak.row.bound for label, peak in law.find_peaks()[3] if label.endswith(" on 3–4")}
    assert bounds == {"velocity on 3–4": 36.0} | {
        f"jerk {a} on 3–4": b for a, b in zip("xyz", (5.0, 6.0, 10.0), strict=True)
    }


def make_arcs(limits, body, own):
    """Arcs about skew axes: pieces of several shapes mixed on one leg, every third with limits of its own."""
    rng, segments = np.random.default_rng(11), []
    for k in range(7):
        shapes = [(1 + (k + p) % 3, 1 + (2 * k + p) % 5) for p in range(1 + k)]
        pieces = [
            piece(rng.uniform(0.1, 2), rng.normal(size=c).tolist(), rng.normal(size=m).tolist())
            for c, m in shapes
        ]
        bounds = own if k % 3 == 0 else None
        segments.append(arc(str(k), str(k + 1), pieces, axis=rng.normal(size=3).tolist(), limits=bounds))
    return from_document(document(segments, limits, body=body))


ARC_LIMITS = [
    {"velocity": 1.0, "snap": [10.0] * 3},
    {"torque": [9.0] * 3, "momentum": 9.0, "jerk": 3.0},
    {"torque": 9.0, "acceleration": 1.0},
]


@pytest.mark.parametrize("limits", ARC_LIMITS)
@pytest.mark.parametrize("body", [BODY, WHEELS])
def test_peaks_of_all_arcs_are_those_of_each_alone_and_of_their_values(limits, body):
    law = make_arcs(limits, body, {"velocity": [1.0, 2.0, 3.0]})
    for segment, together in zip(law.segments, law.find_peaks(), strict=True):
        (alone,) = replace(law, segments=(segment,)).find_peaks()
        assert [label for label, _ in together] == [label for label, _ in alone]
        assert sum(label.endswith(f" on {segment.name}") for label, _ in together) == 3 * bool(segment.limits)
        tau = np.concatenate([np.linspace(a, b, 101) for a, b in pairwise(segment.breaks)])
        values = [{k: segment.profile(tau, k, side) for k in range(1, 5)} for side in ("left", "right")]
        for (_, peak), (_, other) in zip(together, alone, strict=True):
            assert (peak.lower, peak.upper, peak.at) == pytest.approx((other.lower, other.upper, other.at))
            factors = {k: float(v) for k, v in vars(peak.row).items() if isinstance(v, Ball)}
            row = replace(peak.row, **factors)
            size = max(np.max(np.abs(row.value(rates))) for rates in values)
            assert size <= peak.upper * (1 + 1e-12)
            assert size == pytest.approx(peak.upper, rel=1e-3)
            assert peak.lower <= peak.upper <= peak.lower * (1 + 1e-11)
            sides = [
                {k: segment.profile(peak.at, k, side) for k in range(1, 5)} for side in ("left", "right")
            ]
            reached = max(abs(float(row.value(rates))) for rates in sides)
            assert reached == pytest.approx(peak.lower, rel=1e-6)


def test_edges_of_all_arcs_are_their_own_rates():
    law, (nodes, weights) = make_arcs({"velocity": 1.0}, BODY, None), np.polynomial.legendre.leggauss(20)
    for segment, edges in zip(law.segments, law.edges, strict=True):
        for k in range(1, 5):
            np.testing.assert_allclose(edges.sides[k - 1, 0], segment(np.zeros(1), k, "right")[0], rtol=1e-12)
            np.testing.assert_allclose(edges.sides[k - 1, 1], segment(np.ones(1), k, "left")[0], rtol=1e-12)
            breaks = segment.breaks[1:-1]
            jumps = segment(breaks, k, "right") - segment(breaks, k, "left")
            np.testing.assert_allclose(edges.jumps[k - 1], jumps, rtol=1e-9, atol=1e-9)
            means = [
                (weights / 2 @ rate((nodes + 1) / 2) ** 2) ** 0.5 for rate in segment.profile.derivative(k)
            ]
            assert edges.sums[k - 1] == pytest.approx(
                np.dot(means, [p.duration for p in segment.profile.pieces]), rel=1e-12
            )
        single = max(enclose_peaks(segment.profile.derivative(2)), key=lambda peak: peak.lower)
        assert segment.find_largest([segment])[1] == pytest.approx(single.lower, rel=1e-12)


def test_edges_and_largest_rates_of_all_segments_are_those_of_each_alone():
    law = make_many({"velocity": 1.0}, BODY)
    largest = []
    for segment, edges in zip(law.segments, law.edges, strict=True):
        (alone,) = segment.list_edges([segment])
        np.testing.assert_allclose(edges.sides, alone.sides, rtol=1e-13)
        np.testing.assert_allclose(edges.jumps, alone.jumps, rtol=1e-13, atol=1e-12)
        np.testing.assert_allclose(edges.sums, alone.sums, rtol=1e-13)
        largest.append(segment.find_largest([segment]))
        for k in range(1, 5):
            np.testing.assert_allclose(edges.sides[k - 1, 0], segment(np.zeros(1), k, "right")[0], rtol=1e-12)
            np.testing.assert_allclose(edges.sides[k - 1, 1], segment(np.ones(1), k, "left")[0], rtol=1e-12)
            breaks = segment.breaks[1:-1]
            jumps = segment(breaks, k, "right") - segment(breaks, k, "left")
            np.testing.assert_allclose(edges.jumps[k - 1], jumps, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(law.find_largest(), np.max(largest, axis=0), rtol=1e-12)
