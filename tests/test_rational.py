"""Rational segments: rates against automatic differentiation in 40 digits, bounds against exact arithmetic."""

from fractions import Fraction
from itertools import pairwise
from math import comb

import mpmath
import numpy as np
import pytest
from flint import arb, arb_poly, ctx, fmpq, fmpq_poly

from timelaw.certificate import certify
from timelaw.law_file import from_document, to_document
from timelaw.limits import LIMITS as LIMITS_OF_ALL
from timelaw.limits.formula import dot
from timelaw.motion.deviation import DeviationRow
from timelaw.motion.quaternion_curve import QuaternionCurve, stack_curves
from timelaw.numerics.quotient import Quotient, divide

LIMITS = {"velocity": 1.0, "acceleration": 2.0, "jerk": 10.0}


def make_curve(rng, degree=6, step=0.15, duration=None):
    q = rng.normal(size=4)
    steps = rng.normal(size=(degree, 4)) * step
    control = np.concatenate([[q / np.linalg.norm(q)], q / np.linalg.norm(q) + np.cumsum(steps, axis=0)])
    return QuaternionCurve(duration or rng.uniform(0.3, 3), control)


def make_form(curve):
    (stack,) = stack_curves([curve])
    return stack.form


def read(stack, u):
    (polynomial,) = stack.list_rows()
    return polynomial(np.array([u]))[0]


def taylor(curve, u, order):
    """Taylor coefficients in time of Q, in 40 digits."""
    with mpmath.workdps(40):
        h = mpmath.mpf(curve.duration)
        degree = len(curve.control) - 1
        found = []
        for column in curve.control.T:
            points = [mpmath.mpf(float(c)) for c in column]
            value = []
            for k in range(order + 1):
                n = len(points) - 1
                x = mpmath.mpf(u)
                here = mpmath.fsum(comb(n, i) * x**i * (1 - x) ** (n - i) * p for i, p in enumerate(points))
                value.append(here / mpmath.factorial(k))
                points = [n * (b - a) / h for a, b in pairwise(points)] or [mpmath.mpf(0)]
            found.append(value)
        assert degree >= 1
        return found


def series_rates(curve, u):
    """ω, α, jerk, snap from the Taylor series of Q/|Q| and q′ = ½ q ⊗ ω."""
    with mpmath.workdps(40):
        order = 4
        q = taylor(curve, u, order)

        def times(a, b):
            return [mpmath.fsum(a[i] * b[k - i] for i in range(k + 1)) for k in range(len(a))]

        square = [mpmath.fsum(times(c, c)[k] for c in q) for k in range(order + 1)]
        root = [mpmath.sqrt(square[0])]
        for k in range(1, order + 1):
            root.append((square[k] - mpmath.fsum(root[i] * root[k - i] for i in range(1, k))) / (2 * root[0]))
        inverse = [1 / root[0]]
        for k in range(1, order + 1):
            inverse.append(-mpmath.fsum(root[i] * inverse[k - i] for i in range(1, k + 1)) / root[0])
        unit = [times(c, inverse) for c in q]
        slope = [[(k + 1) * c[k + 1] for k in range(order)] for c in unit]
        w, x, y, z = (c[:order] for c in unit)
        a, b, c, d = slope
        minus = lambda p, r: [m - n for m, n in zip(p, r, strict=True)]  # noqa: E731
        add = lambda p, r: [m + n for m, n in zip(p, r, strict=True)]  # noqa: E731
        omega = [
            minus(minus(add(times(w, b), times(z, c)), times(x, a)), times(y, d)),
            minus(minus(add(times(w, c), times(x, d)), times(y, a)), times(z, b)),
            minus(minus(add(times(w, d), times(y, b)), times(z, a)), times(x, c)),
        ]
        return [[float(2 * mpmath.factorial(k) * o[k]) for o in omega] for k in range(order)]


@pytest.mark.parametrize("seed", range(12))
def test_rates_are_those_of_the_normalised_curve(seed):
    rng = np.random.default_rng(seed)
    curve = make_curve(rng, degree=int(rng.integers(1, 10)))
    for u in (0.0, 0.3, 1.0):
        form = make_form(curve)
        numerators, square = form.numerators(4), read(form.power(1), u)
        for k, exact in enumerate(series_rates(curve, u), 1):
            size = np.linalg.norm(exact) + curve.duration**-k
            assert np.linalg.norm(curve(np.array([u]), k)[0] - exact) < 1e-11 * size
            formula = [read(part, u) / square**k for part in numerators[k]]
            assert np.linalg.norm(np.subtract(formula, exact)) < 1e-11 * size


def power_form(control):
    """An exact polynomial in u from control points that are doubles."""
    n = len(control) - 1
    total = fmpq_poly([])
    for i, c in enumerate(control):
        f = Fraction(float(c))
        weight = fmpq(f.numerator, f.denominator) * comb(n, i)
        total += fmpq_poly([0] * i + [1]) * fmpq_poly([1, -1]) ** (n - i) * weight
    return total


def exact_rates(curve):
    """|X_k|² and D^2k, exact in u."""
    h = Fraction(float(curve.duration))
    slow = fmpq(h.denominator, h.numerator)
    q = [power_form(column) for column in curve.control.T]
    v = [p.derivative() * slow for p in q]
    square = sum((p * p for p in q), fmpq_poly([]))

    def vector(a, b):
        return [
            a[0] * b[1] - b[0] * a[1] - (a[2] * b[3] - a[3] * b[2]),
            a[0] * b[2] - b[0] * a[2] - (a[3] * b[1] - a[1] * b[3]),
            a[0] * b[3] - b[0] * a[3] - (a[1] * b[2] - a[2] * b[1]),
        ]

    x = [2 * p for p in vector(q, v)]
    found = []
    for k in (1, 2, 3):
        found.append((sum((p * p for p in x), fmpq_poly([])), square ** (2 * k)))
        x = [p.derivative() * slow * square - k * p * square.derivative() * slow for p in x]
    return found


def largest(num, den):
    """Max of num/den on [0, 1] as a ball: at the ends, and where num′ den = num den′."""
    ctx.prec = 400
    critical = num.derivative() * den - num * den.derivative()
    places = [arb(0), arb(1)]
    for root, _ in critical.complex_roots():
        if root.imag.contains(0) and root.real > -1e-30 and root.real < 1 + arb(1e-30):
            places.append(root.real)
    up, low = arb_poly(num), arb_poly(den)
    return max((up(place) / low(place) for place in places), key=float)


@pytest.mark.parametrize("seed", range(15))
def test_bounds_enclose_the_exact_maxima(seed):
    rng = np.random.default_rng(100 + seed)
    curve = make_curve(rng, degree=int(rng.integers(2, 7)), step=float(10 ** rng.uniform(-3, -0.8)))
    form = make_form(curve)
    numerators = form.numerators(3)
    made = [divide(dot(numerators[k], numerators[k]), form.power(2 * k))[0] for k in (1, 2, 3)]
    for peak, (num, den) in zip(Quotient.enclose_all(made), exact_rates(curve), strict=True):
        exact = largest(num, den)
        assert peak.lower <= float(exact) * (1 + 1e-15)
        assert not exact > arb(peak.upper)
        assert peak.upper <= float(exact) * (1 + 1e-9)


def rest_to_rest(first, last, duration):
    """A quintic that is at rest at both ends."""
    control = [first] * 3 + [last] * 3
    return QuaternionCurve(duration, np.array(control))


def make_law(duration=4.0, limits=LIMITS):
    first, last = np.array([1.0, 0, 0, 0]), np.array([0.8, 0.36, 0.48, 0.0])
    piece = {"duration": duration, "control": rest_to_rest(first, last, duration).control.tolist()}
    segment = {
        "kind": "rational",
        "from": "1",
        "to": "2",
        "start_time": 0.0,
        "duration": duration,
        "start": first.tolist(),
        "end": last.tolist(),
        "pieces": [piece],
    }
    return {
        "format": "timelaw-law",
        "version": 2,
        "name": "rational",
        "conventions": {
            "quaternion": "wxyz, Hamilton, active, body to world",
            "rates": "body axes",
            "units": "rad, s",
        },
        "duration": duration,
        "continuity": 2,
        "limits": limits,
        "segments": [segment],
    }


def test_a_rational_law_is_read_written_evaluated_and_certified():
    document = make_law()
    law = from_document(document)
    assert to_document(law)["segments"] == document["segments"]
    certificate = certify(law)
    assert certificate.findings() == []
    assert certificate.continuity.order == 2
    assert np.linalg.norm(law(2.0)) == pytest.approx(1, abs=1e-15)
    t = np.linspace(0, 4, 2001)
    for check, order in zip(certificate.limits, (1, 2, 3), strict=True):
        sampled = float(np.max(np.linalg.norm(law(t, order), axis=1)))
        assert sampled <= check.upper <= sampled * (1 + 1e-4)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_a_limit_holds_just_above_the_peak_and_not_just_below(order):
    name = list(LIMITS)[order - 1]
    peak = certify(from_document(make_law())).limits[order - 1].upper
    for factor, holds in ((1 + 1e-9, True), (1 - 1e-9, False)):
        law = from_document(make_law(limits=LIMITS | {name: peak * factor}))
        assert (certify(law).findings() == []) is holds


@pytest.mark.parametrize(
    ("changes", "finding"),
    [
        ({"end": [0.8, 0.48, 0.36, 0.0]}, "nodes are met"),
        ({"end": [-0.8, -0.36, -0.48, 0.0]}, "nodes are met: off by 6.28 rad"),
        ({"start": [1.0, 1e-9, 0.0, 0.0]}, "nodes are met"),
        ({"duration": 4.0000001}, "pieces take their segment's time"),
    ],
)
def test_what_is_wrong_with_it_is_found(changes, finding):
    law = make_law()
    law["segments"][0] |= changes
    assert any(finding in f for f in certify(from_document(law)).findings())


def test_a_curve_through_zero_has_no_bound():
    law = make_law()
    law["segments"][0]["pieces"][0]["control"][5] = [-0.8, -0.36, -0.48, 0.0]
    law["segments"][0]["pieces"][0]["control"][3:5] = [[-1.0, 0.0, 0.0, 0.0]] * 2
    assert not certify(from_document(law)).holds


BODY = {"inertia": [[12.0, 0.5, -1.0], [0.5, 10.0, 0.3], [-1.0, 0.3, 8.0]]}
WHEELS = BODY | {"actuator": "wheels", "momentum": [0.3, -0.2, 0.5]}


def measure(law, name, t):
    """What a limit bounds, (m, 3), by Euler's equations from the law's own samples."""
    omega, alpha = law(t, 1), law(t, 2)
    if name.startswith("linear"):
        return law.place(t, ["linear_velocity", "linear_acceleration"].index(name) + 1)
    if name in ("velocity", "acceleration", "jerk", "snap"):
        return law(t, ["velocity", "acceleration", "jerk", "snap"].index(name) + 1)
    inertia = law.body.inertia
    momentum = omega @ inertia.T
    total = np.zeros_like(omega)
    if law.body.actuator == "wheels":
        world = law.rotation(0.0) @ law.body.momentum
        total = np.einsum("mij,i->mj", law.rotation(t), world)
    if name == "momentum":
        return total - momentum
    turned = total if law.body.actuator == "wheels" else momentum
    return alpha @ inertia.T + np.cross(omega, turned)


@pytest.mark.parametrize("name", LIMITS_OF_ALL)
@pytest.mark.parametrize("body", [BODY, WHEELS])
@pytest.mark.parametrize("by_axis", [False, True])
def test_every_limit_is_proved_by_its_own_formula(name, body, by_axis):
    document = make_law(limits={name: [1e3] * 3 if by_axis else 1e3}) | {"body": body, "continuity": 0}
    points = np.random.default_rng(5).normal(size=(8, 3))
    document["segments"][0]["pieces"][0]["points"] = points.tolist()
    law = from_document(document)
    values = np.abs(measure(law, name, np.linspace(0, law.duration, 4001)))
    tops = np.max(values, axis=0) if by_axis else [np.max(np.linalg.norm(values, axis=1))]
    checks = certify(law).limits
    assert len(checks) == len(tops)
    for check, top in zip(checks, tops, strict=True):
        assert top * (1 - 1e-12) <= check.upper <= top * (1 + 1e-4) + 1e-11


@pytest.mark.parametrize("short", [0.0, 1e-9, 3e-8, 1e-6, 1e-3, 1.0, 3.0])
def test_angles_of_deviations_are_right_to_the_last_digits(short):
    """Near half a turn too, where a sine alone tells nothing: no bound allows more than its angle."""
    angle = np.pi - short
    row = DeviationRow(angle)
    assert row.size(row.bound) <= angle
    assert row.size(row.bound) >= angle - 5e-8
    with mpmath.workdps(40):
        exact = 2 * mpmath.asin(mpmath.sqrt(mpmath.mpf(row.bound)))
        assert abs(row.size(row.bound) - exact) <= 1e-15 * exact
