"""Past every node without a stop: the search against finite differences, figures of earlier trials, the proof."""

from dataclasses import replace

import numpy as np
import pytest

from tests.cases import reference
from timelaw.least_time.double_s import double_s_time
from timelaw.limits.body import RigidBody
from timelaw.motion.quaternion_curve import QuaternionCurve
from timelaw.numerics.quaternion import multiply, normalise, rotation_between
from timelaw.through.columns import number_columns
from timelaw.through.curve import Curve, make_curve
from timelaw.through.ladder import Form, Stretch, climb
from timelaw.through.least_time import LeastTime
from timelaw.through.leaving import limit_deviation
from timelaw.through.measures import find_use, list_limit_measures, sample_used
from timelaw.through.more_pieces import split
from timelaw.through.rows import derive_vector, look_at
from timelaw.through.search import improve
from timelaw.through.start import begin

DEG = np.pi / 180
NAMES = ("velocity", "acceleration", "jerk", "snap")
BODY = RigidBody(np.array([[12.0, 1.0, -0.5], [1.0, 10.0, 0.7], [-0.5, 0.7, 8.0]]))
WHEELS = replace(BODY, actuator="wheels", momentum=np.array([0.3, -0.2, 0.5]))
PLACES = np.array([0.0, 0.2, 0.7, 1.0])


def make_limits(*bounds, legs=11):
    given = {
        n: tuple(np.multiply(b, DEG)) if np.ndim(b) else b * DEG for n, b in zip(NAMES, bounds, strict=False)
    }
    return list_limit_measures(given, [{}] * legs)


def random_curve(rng, legs, pieces, degree, smooth=2):
    knots = legs * pieces + 1
    steps = np.cumsum(rng.normal(size=(knots, 4)) * 0.3, axis=0)
    turn = normalise(steps + np.eye(4)[0])
    turn[1:] *= np.cumprod(np.sign(np.sum(turn[1:] * turn[:-1], axis=1)))[:, None]
    rates = rng.normal(size=(knots, smooth, 3)) * 0.3
    return make_curve(degree, pieces, turn, rates, rng.uniform(0.5, 2, legs))


def list_curves(curve):
    return [QuaternionCurve(float(h), b) for h, b in zip(curve.steps, curve.control(), strict=True)]


FORMS = [(5, 2), (6, 2), (7, 2), (9, 2), (7, 3), (8, 3), (9, 3)]


@pytest.mark.parametrize(("degree", "smooth"), FORMS)
def test_knots_have_their_states(degree, smooth):
    curve = random_curve(np.random.default_rng(degree), 3, 2, degree, smooth)
    for k, piece in enumerate(list_curves(curve)):
        ends = np.array([0.0, 1.0])
        np.testing.assert_allclose(piece(ends, 0), curve.turn[k : k + 2], atol=1e-13)
        for order in range(1, smooth + 1):
            found = curve.rates[k : k + 2, order - 1]
            np.testing.assert_allclose(piece(ends, order), found, atol=1e-12 * 30**order)


def list_all_measures(curve, nodes):
    wide = {"velocity": 1.0, "acceleration": (1.0, 2.0, 3.0), "jerk": 1.0, "torque": 2.0, "momentum": 1.0}
    legs = [{}] * len(curve.duration)
    found = list_limit_measures(wide | {"snap": 4.0}, legs, BODY)
    found += list_limit_measures({"torque": 2.0, "momentum": (1.0, 1.0, 2.0)}, legs, WHEELS, [0.4, -0.1, 0.2])
    return [*found, limit_deviation(nodes, 0.3)]


@pytest.mark.parametrize(("degree", "smooth", "pieces", "clocks"), [(5, 2, 2, True), (8, 3, 1, False)])
def test_slopes_are_finite_differences(degree, smooth, pieces, clocks):
    """Of every limit, by every variable of a piece."""
    curve = random_curve(np.random.default_rng(20 + degree), 2, pieces, degree, smooth)
    columns = number_columns(curve, np.zeros(3, dtype=bool), clocks=clocks)
    for measure in list_all_measures(curve, curve.turn[::pieces]):
        piece = np.repeat(np.arange(2 * pieces), len(PLACES))

        def look(one, measure=measure, piece=piece):
            slopes = columns.by_clock(one, one.slopes())
            seen = look_at(one, slopes, piece, np.tile(PLACES, 2 * pieces), measure.highest)
            value, slope, by_step = derive_vector(one, measure, seen, np.arange(len(piece)))
            slope[..., 2 * one.columns[0]] += by_step
            return value.reshape(-1, len(PLACES), 3), slope.reshape(-1, len(PLACES), 3, slope.shape[-1])

        value, slopes = look(curve)
        total = np.zeros((*slopes.shape[:3], columns.count + 1))  # the last one of those that are fixed
        for k, place in np.ndindex(columns.of_pieces.shape):
            total[k, ..., columns.of_pieces[k, place]] += slopes[k, ..., place]
        size = 1 + np.max(np.abs(value))
        for column, step in enumerate(1e-6 * np.eye(columns.count)):
            up, down = (look(columns.move(curve, change))[0] for change in (step, -step))
            np.testing.assert_allclose((up - down) / 2e-6, total[..., column], rtol=1e-5, atol=3e-7 * size)


def test_used_parts_are_those_of_the_motion():
    """Against the motion's own rates, and the factor of a limit with a total momentum against a slower curve."""
    curve = random_curve(np.random.default_rng(4), 3, 1, 7)
    used = sample_used(curve, make_limits(60, 120, 600, legs=3), 9)
    for k, piece in enumerate(list_curves(curve)):
        for order, bound in enumerate((60, 120, 600), 1):
            size = np.linalg.norm(piece(np.linspace(0, 1, 9), order), axis=1) / (bound * DEG)
            np.testing.assert_allclose(used[k, :, order - 1], size ** (1 / order), rtol=1e-9)
    wheels = list_limit_measures({"torque": 0.7, "momentum": 0.9}, [{}] * 3, WHEELS, [0.3, -0.2, 0.5])
    for measure in wheels:
        factor = find_use(curve, [measure]).worst
        assert find_use(curve.stretched(factor), [measure]).worst == pytest.approx(1, abs=1e-6)


@pytest.fixture(scope="module")
def tour():
    """The paper's nodes and angles."""
    legs = reference("paper-24-cell").route.legs
    return np.array([legs[0].start, *(leg.end for leg in legs)]), np.array([leg.angle for leg in legs])


def lay(tour, bounds, **settings):
    nodes, angles = tour
    stops = np.array([double_s_time(angle, *(b * DEG for b in bounds)) for angle in angles])
    return Stretch(nodes, angles, stops, **settings), sum(stops)


def is_within(curve, measures):
    """Looked at between the places where the search looks."""
    use = find_use(curve, measures, 1001)
    return use.worst <= 1 + 1e-6 and not use.excess


@pytest.mark.parametrize(
    ("bounds", "one", "two"),
    [
        ((60, 120, 600), 23.99 / 29.7, 23.72 / 29.7),
        ((1, 0.05, 0.01), 0.891, 0.871),
        ((720, 2000, 100000), 0.678, 0.667),
    ],
)
def test_the_papers_tour_without_a_stop(tour, bounds, one, two):
    """Figures of trials: parts of the double-S that stops at every node."""
    limits = make_limits(*bounds)
    stretch, stopping = lay(tour, bounds)
    curve, rungs = climb(stretch, limits, Form(2))
    assert [(rung.degree, rung.pieces) for rung in rungs] == [(6, 1), (6, 2)]
    assert rungs[0].time <= one * stopping
    assert curve.total == rungs[1].time <= two * stopping
    assert is_within(curve, limits)
    np.testing.assert_array_equal(curve.turn[::2], stretch.turn)


def test_jerk_without_jumps(tour):
    """Class C³: a little slower."""
    limits = make_limits(60, 120, 600)
    curve, _ = climb(lay(tour, (60, 120, 600))[0], limits, Form(3, pieces=1))
    assert curve.smooth == 3
    assert curve.total <= 24.25
    assert is_within(curve, limits)


@pytest.mark.parametrize(("degrees", "time"), [(10, 24.4), (5, 25.1), (2, 26.0), (1, 26.5)])
def test_a_bound_on_leaving_the_arcs(tour, degrees, time):
    limits = make_limits(60, 120, 600)
    curve, _ = climb(lay(tour, (60, 120, 600))[0], limits, Form(2, pieces=1, deviation=degrees * DEG))
    assert curve.total <= time
    assert is_within(curve, [*limits, limit_deviation(tour[0], degrees * DEG)])


def test_a_tour_that_goes_round(tour):
    nodes, angles = tour
    back = nodes[0] if nodes[-1] @ nodes[0] > 0 else -nodes[0]
    closed = np.vstack([nodes, back]), np.append(angles, 2 * np.arccos(nodes[-1] @ back))
    bounds = (60, 120, 600)
    stretch, stopping = lay(closed, bounds, periodic=True)
    curve, _ = climb(stretch, make_limits(*bounds, legs=12), Form(2, pieces=1))
    np.testing.assert_array_equal(curve.rates[0], curve.rates[-1])
    assert np.linalg.norm(curve.rates[0, 0]) > 0.1
    assert curve.total <= 0.7905 * stopping  # the figure of trials


def test_limits_by_axis_and_a_stop_on_the_way(tour):
    limits = make_limits([60, 50, 40], [120, 120, 90], 600)
    stretch, _ = lay(tour, (40, 90, 600), rests=(4,))
    curve, _ = climb(stretch, limits, Form(2, pieces=1))
    assert not np.any(curve.rates[4])
    assert np.linalg.norm(curve.rates[3, 0]) > 0.1
    assert is_within(curve, limits)


@pytest.mark.parametrize("body", [BODY, WHEELS])
def test_torque_and_momentum(tour, body):
    total = multiply(multiply(tour[0][0], np.append(0.0, body.momentum)), tour[0][0] * [1, -1, -1, -1])[1:]
    given = {"jerk": 600 * DEG, "torque": 15.0, "momentum": 9.0}
    limits = list_limit_measures(given, [{}] * 11, body, list(total))
    curve, _ = climb(lay(tour, (40, 60, 600))[0], limits, Form(2, pieces=1))
    assert is_within(curve, limits)
    assert find_use(curve, limits).worst > 0.999


@pytest.mark.parametrize("pieces", [2, 3])
def test_a_split_is_nearly_the_same_path(tour, pieces):
    nodes, _ = tour
    stops = lay(tour, (60, 120, 600))[0].durations
    limits = make_limits(60, 120, 600)
    curve = begin(nodes, [], stops, 6, limits)
    parts = split(curve, pieces)
    assert parts.total == pytest.approx(curve.total, rel=1e-12)
    u = np.linspace(0, 1, 7)
    for k, piece in enumerate(list_curves(parts)):
        leg, part = divmod(k, pieces)
        whole = list_curves(curve)[leg]
        for a, b in zip(piece(u, 0), whole((u + part) / pieces, 0), strict=True):
            assert rotation_between(a, b) < 0.02


def test_the_search_is_the_same_every_time_and_never_slower_than_its_start(tour):
    nodes, angles = tour
    stretch, _ = lay(tour, (60, 120, 600))
    limits = make_limits(60, 120, 600)
    start = begin(nodes, [], stretch.durations, 5, limits)
    columns = number_columns(start, stretch.held)
    first, second = (improve(start, columns, angles, LeastTime(limits)).curve for _ in range(2))
    assert isinstance(first, Curve)
    np.testing.assert_array_equal(first.control(), second.control())
    assert first.total < start.total
