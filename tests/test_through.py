"""Past every node without a stop: the search against finite differences, figures of earlier trials, the proof."""

from dataclasses import replace

import numpy as np
import pytest

from tests.cases import reference
from timelaw.certificate import certify
from timelaw.certificate.limit_check import find_leg_peaks
from timelaw.least_time.double_s import double_s_time
from timelaw.motion import QuaternionLaw
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.motion.rational import Rational
from timelaw.numerics.quaternion import multiply, normalise, rotation_between
from timelaw.through.curve import KNOT, Curve, make_curve
from timelaw.through.more_pieces import split
from timelaw.through.rate_limits import RateLimits, find_stretch
from timelaw.through.search import improve
from timelaw.through.start import align_signs, begin
from timelaw.through.turning_rows import derive_rates, make_basis, measure_rates

DEG = np.pi / 180
NAMES = ("velocity", "acceleration", "jerk")


def make_limits(*bounds):
    return RateLimits({k: np.asarray(b) * DEG for k, b in enumerate(bounds, 1)})


def random_curve(rng, legs, pieces, degree):
    knots = legs * pieces + 1
    steps = np.cumsum(rng.normal(size=(knots, 4)) * 0.3, axis=0)
    turn = align_signs(normalise(steps + np.eye(4)[0]))
    omega, alpha = rng.normal(size=(2, knots, 3)) * 0.3
    return make_curve(degree, pieces, turn, omega, alpha, rng.uniform(0.5, 2, legs))


def list_curves(curve):
    return [QuaternionCurve(float(h), b) for h, b in zip(curve.steps, curve.control(), strict=True)]


@pytest.mark.parametrize("degree", [5, 6, 7, 9])
def test_knots_have_their_states(degree):
    curve = random_curve(np.random.default_rng(degree), 3, 2, degree)
    for k, piece in enumerate(list_curves(curve)):
        ends = np.array([0.0, 1.0])
        np.testing.assert_allclose(piece(ends, 0), curve.turn[k : k + 2], atol=1e-13)
        np.testing.assert_allclose(piece(ends, 1), curve.omega[k : k + 2], atol=1e-12)
        np.testing.assert_allclose(piece(ends, 2), curve.alpha[k : k + 2], atol=1e-11)


def vary(curve, column, step):
    """X of every piece by itself, one of its columns moved."""
    moved = []
    for k in range(len(curve.weight)):
        own = {
            "turn": curve.turn[k : k + 2].copy(),
            "omega": curve.omega[k : k + 2].copy(),
            "alpha": curve.alpha[k : k + 2].copy(),
            "duration": curve.steps[k : k + 1].copy(),
            "weight": curve.weight[k : k + 1].copy(),
            "inner": curve.inner[k : k + 1].copy(),
        }
        if column < 2 * KNOT:
            knot, place = divmod(column, KNOT)
            if place < 6:
                own["omega" if place < 3 else "alpha"][knot, place % 3] += step
            else:
                turn = np.eye(4)[0] + step * np.eye(4)[place - 5]
                own["turn"][knot] = multiply(own["turn"][knot], turn)
        elif column == 2 * KNOT:
            own["duration"] += step
        elif column == 2 * KNOT + 1:
            own["weight"] += step
        else:
            own["inner"][0, (column - 2 * KNOT - 2) // 3, (column - 2 * KNOT - 2) % 3] += step
        moved.append(replace(curve, pieces=1, middle=curve.middle[k : k + 1], **own))
    return moved


@pytest.mark.parametrize("degree", [5, 6, 8])
def test_slopes_are_finite_differences(degree):
    curve = random_curve(np.random.default_rng(20 + degree), 2, 2, degree)
    basis = make_basis(degree, np.array([0.0, 0.2, 0.7, 1.0]))
    points = curve.control()
    rates = derive_rates(points, basis)
    for k, piece in enumerate(list_curves(curve)):
        alone = QuaternionCurve(1.0, piece.control)
        for order in (1, 2, 3):
            np.testing.assert_allclose(
                rates.value[k, :, order - 1], alone(np.array([0.0, 0.2, 0.7, 1.0]), order), atol=1e-10
            )
    slopes = np.einsum(
        "pmxykc,pmkcv->pmxyv", rates.slope, np.einsum("mko,pocv->pmkcv", basis, curve.slopes(points))
    )
    for column in range(slopes.shape[-1]):
        up, down = (
            np.array([measure_rates(one.control(), basis)[0] for one in vary(curve, column, step)])
            for step in (1e-6, -1e-6)
        )
        size = 1e-3 + np.max(np.abs(slopes[..., column]))
        np.testing.assert_allclose((up - down) / 2e-6, slopes[..., column], atol=1e-6 * size)


def compose(curve, nodes, limits):
    """The law of a curve through nodes (n, 4)."""
    segments, time = [], 0.0
    pieces = list_curves(curve)
    for k in range(len(nodes) - 1):
        own = tuple(pieces[k * curve.pieces : (k + 1) * curve.pieces])
        duration = float(curve.duration[k]) * curve.pieces
        segments.append(Rational(str(k), str(k + 1), time, duration, nodes[k], nodes[k + 1], own))
        time += duration
    given = {NAMES[k - 1]: tuple(b.tolist()) if b.ndim else float(b) for k, b in limits.bounds.items()}
    return QuaternionLaw("through", tuple(segments), given, continuity=2)


def prove(curve, nodes, limits):
    """The law that is certified after the exact stretch; how much that was."""
    peaks = find_leg_peaks(compose(curve, nodes, limits))
    factor = max(peak.used ** (1 / peak.row.orders[0]) for peak in peaks)
    law = compose(curve.stretched(max(factor * (1 + 1e-11), 1.0)), nodes, limits)
    assert certify(law).findings() == []
    return law, factor


@pytest.fixture(scope="module")
def tour():
    """The paper's nodes, angles, and where the body is at rest."""
    legs = reference("paper-24-cell").route.legs
    nodes = align_signs(np.array([*(leg.start for leg in legs), legs[-1].end]))
    rests = np.zeros(len(nodes), dtype=bool)
    rests[[0, -1]] = True
    return nodes, np.array([leg.angle for leg in legs]), rests


@pytest.mark.parametrize(
    ("bounds", "one", "two"),
    [
        ((60, 120, 600), 23.99 / 29.7, 23.72 / 29.7),
        ((1, 0.05, 0.01), 0.892, 0.871),
        ((720, 2000, 100000), 0.678, 0.667),
    ],
)
def test_the_papers_tour_without_a_stop(tour, bounds, one, two):
    """Figures of trials: parts of the double-S that stops at every node."""
    nodes, angles, rests = tour
    limits = make_limits(*bounds)
    stopping = sum(double_s_time(angle, *(b * DEG for b in bounds)) for angle in angles)
    start = begin(nodes, [], limits, 6)
    found = improve(start, rests, angles, limits).curve
    law, factor = prove(found, nodes, limits)
    assert factor <= 1 + 1e-4
    assert law.duration <= one * stopping < start.total
    cut = split(found, 2)
    cut = cut.stretched(float(np.max(find_stretch(cut, limits))))
    halves = improve(cut, rests, angles, limits, radius=0.1).curve
    law, _ = prove(halves, nodes, limits)
    assert law.duration <= two * stopping
    for time, node in zip(law.times, nodes, strict=True):
        assert rotation_between(law(time), node) < 1e-9


def test_limits_by_axis_and_a_stop_on_the_way(tour):
    nodes, angles, rests = tour
    limits = make_limits([60, 50, 40], [120, 120, 90], 600)
    stopped = rests.copy()
    stopped[4] = True
    found = improve(begin(nodes, [4], limits, 6), stopped, angles, limits).curve
    law, _ = prove(found, nodes, limits)
    assert np.linalg.norm(law(law.times[4], 1)) == 0
    assert np.linalg.norm(law(law.times[3], 1)) > 0.1


def test_the_search_is_the_same_every_time_and_never_slower_than_its_start(tour):
    nodes, angles, rests = tour
    limits = make_limits(60, 120, 600)
    start = begin(nodes, [], limits, 5)
    first, second = (improve(start, rests, angles, limits).curve for _ in range(2))
    assert isinstance(first, Curve)
    np.testing.assert_array_equal(first.control(), second.control())
    assert first.total < start.total
