"""The emitted file by kinematics of its own: exact fractions, Taylor arithmetic, and an integrator of q′ = ½ q ⊗ ω.

Nothing here is taken from the program but the file it writes, and what it is compared with.
"""

import json
from bisect import bisect_right
from fractions import Fraction
from itertools import accumulate, pairwise
from math import comb, cos, factorial, sin

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.cases import reference
from timelaw.export import format_law

PROBLEMS = ("first-steps", "paper-24-cell", "camera-scan", "wrist-calibration")
PIECES = 3  # of a segment, at random, where every rate is told
ORDERS = 5  # of the Taylor series: q and four rates


def powers(piece):
    """Coefficients of φ in powers of the time since the piece's start, exactly."""
    control, h = [Fraction(c) for c in piece["bernstein"]], Fraction(piece["duration"])
    n = len(control) - 1
    top = [
        comb(n, k) * sum((-1) ** (k - i) * comb(k, i) * control[i] for i in range(k + 1)) / h**k
        for k in range(n + 1)
    ]
    for value in map(Fraction, piece["state"][::-1]):
        top = [value, *(c / k for k, c in enumerate(top, 1))]
    return top


def expand(coefficients, t):
    """Taylor coefficients of φ at t, as floats."""
    return [
        float(sum(comb(k, i) * c * t ** (k - i) for k, c in enumerate(coefficients) if k >= i))
        for i in range(ORDERS)
    ]


def times(a, b):
    return [sum(a[i] * b[k - i] for i in range(k + 1)) for k in range(len(a))]


def turn(phi):
    """Taylor coefficients of cos φ/2 and sin φ/2: c' = -s φ'/2, s' = c φ'/2."""
    half = [p / 2 for p in phi]
    c, s = [cos(half[0])], [sin(half[0])]
    for k in range(1, len(phi)):
        c.append(-sum(i * half[i] * s[k - i] for i in range(1, k + 1)) / k)
        s.append(sum(i * half[i] * c[k - i] for i in range(1, k + 1)) / k)
    return c, s


def product(p, q):
    """Hamilton's, of quaternions whose components are Taylor series."""
    signs = (
        ((0, 0, 1), (1, 1, -1), (2, 2, -1), (3, 3, -1)),
        ((0, 1, 1), (1, 0, 1), (2, 3, 1), (3, 2, -1)),
        ((0, 2, 1), (2, 0, 1), (3, 1, 1), (1, 3, -1)),
        ((0, 3, 1), (3, 0, 1), (1, 2, 1), (2, 1, -1)),
    )
    return [
        np.sum([sign * np.array(times(p[i], q[j])) for i, j, sign in row], axis=0).tolist() for row in signs
    ]


def constant(value):
    return [value, *[0.0] * (ORDERS - 1)]


def orientation(segment, coefficients, t):
    """Taylor coefficients (4, 5) of q at t seconds into the piece."""
    c, s = turn(expand(coefficients, t))
    turned = [c, *([n * x for x in s] for n in segment["axis"])]
    return product([constant(w) for w in segment["start"]], turned)


def rates(q):
    """ω = 2 Vec(q* ⊗ q') and its derivatives (4, 3) from the series of q."""
    inverse = [q[0], *([-x for x in part] for part in q[1:])]
    slope = [[*(k * x for k, x in enumerate(part) if k), 0.0] for part in q]
    omega = np.array(product(inverse, slope)[1:]) * 2
    return [omega[:, k] * factorial(k) for k in range(ORDERS - 1)]


def places(segment):
    """Start [s from the segment's], end and coefficients of each piece; one that rests for a dwell."""
    if segment["kind"] == "dwell":
        return [(Fraction(0), Fraction(segment["duration"]), [Fraction(0)])]
    starts = [Fraction(0), *accumulate(Fraction(piece["duration"]) for piece in segment["pieces"])]
    return [(a, b, powers(p)) for a, b, p in zip(starts, starts[1:], segment["pieces"], strict=False)]


def arcs(document):
    rest = {"axis": [1.0, 0.0, 0.0]}
    return [rest | s | {"start": s.get("start", s.get("orientation"))} for s in document["segments"]]


def sizes(law):
    """The largest component of each rate."""
    t = np.linspace(0, law.duration, 2001)
    return [np.max(np.abs(law(t, k))) for k in range(1, ORDERS)]


@pytest.fixture(scope="module", params=PROBLEMS)
def emitted(request):
    designed = reference(request.param)
    return designed.optimised.law, json.loads(
        format_law(designed.optimised.law, designed.optimised.certificate, {})
    )


def test_rates_are_the_derivatives_of_the_orientation(emitted):
    """Between the nodes, and on both sides of every piece's ends."""
    law, document = emitted
    scales = sizes(law)
    rng = np.random.default_rng(1)
    for own, segment in zip(law.segments, arcs(document), strict=True):
        spans = places(segment)
        for index in {0, len(spans) - 1, *rng.integers(len(spans), size=PIECES).tolist()}:
            start, end, coefficients = spans[index]
            middle = start + (end - start) * Fraction(int(rng.integers(1, 63)), 64)
            for t, side in ((start, "right"), (middle, "right"), (end, "left")):
                tau = float(t) / segment["duration"]
                tau = own.breaks[index] if t == start else own.breaks[index + 1] if t == end else tau
                q = orientation(segment, coefficients, t - start)
                found = [own(np.array([tau]), k, side)[0] for k in range(ORDERS)]
                np.testing.assert_allclose(found[0], np.array(q)[:, 0], rtol=0, atol=1e-12)
                for rate, expected, scale in zip(found[1:], rates(q), scales, strict=True):
                    np.testing.assert_allclose(rate, expected, rtol=0, atol=1e-9 * scale)


def test_both_sides_of_every_node(emitted):
    law, document = emitted
    segments, scales = arcs(document), sizes(law)
    for node, (before, after) in enumerate(pairwise(segments), 1):
        first, last = places(after)[0], places(before)[-1]
        sides = (("left", before, last[2], last[1] - last[0]), ("right", after, first[2], Fraction(0)))
        for side, segment, coefficients, t in sides:
            q = orientation(segment, coefficients, t)
            np.testing.assert_allclose(law(law.times[node], 0, side), np.array(q)[:, 0], rtol=0, atol=1e-12)
            for k, expected in enumerate(rates(q), 1):
                found = law(law.times[node], k, side)
                np.testing.assert_allclose(found, expected, rtol=0, atol=1e-11 * scales[k - 1])


def test_the_rates_integrate_to_every_orientation(emitted):
    """From the first orientation on, over the whole tour, never started again."""
    _, document = emitted
    q = np.array(arcs(document)[0]["start"])
    worst = 0.0
    for segment in arcs(document):
        for start, end, coefficients in places(segment):
            slope = np.array([float(k * c) for k, c in enumerate(coefficients) if k] or [0.0])
            axis = np.array(segment["axis"])

            def rotate(t, q, slope=slope, axis=axis):
                w = np.polynomial.polynomial.polyval(t, slope) * axis
                v = q[1:]
                return 0.5 * np.array([-(v @ w), *(q[0] * w + np.cross(v, w))])

            if end > start:
                q = solve_ivp(rotate, (0.0, float(end - start)), q, "DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
        goal = np.array(segment.get("end", segment["start"]))
        worst = max(worst, 2 * np.linalg.norm(q - goal))
    assert worst < 1e-9


def test_pieces_take_the_segments_time_and_join(emitted):
    _, document = emitted
    for segment in (s for s in document["segments"] if s["kind"] == "arc"):
        spans = places(segment)
        assert abs(float(spans[-1][1]) / segment["duration"] - 1) < 1e-12
        assert bisect_right([float(a) for a, _, _ in spans], segment["duration"]) == len(spans)
        reached = [expand(c, b - a) for a, b, c in spans]
        begun = [expand(c, Fraction(0)) for _, _, c in spans]
        assert abs(begun[0][0]) == 0
        assert reached[-1][0] == pytest.approx(segment["angle"], abs=1e-12)
        for left, right in zip(reached, begun[1:], strict=False):
            assert left[:3] == pytest.approx(right[:3], abs=1e-9)
