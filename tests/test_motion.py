"""Time laws and quaternion laws: evaluation at any instant, rates against finite differences."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import reference
from timelaw.certificate.continuity import check_continuity
from timelaw.certificate.effort import measure_effort
from timelaw.requirements.route_limit import find_route_limit
from timelaw.time_law import TimeLaw
from timelaw.time_law.baselines import time_double_s, time_quintic


@pytest.fixture(scope="module", params=["optimised", "quintic", "double-S"])
def law(request, paper):
    return next(entry.law for entry in paper.laws if entry.name == request.param)


def effort(law, order):
    return measure_effort(law, check_continuity(law), order)


def inner_times(law, count=97):
    """Instants well inside the segments."""
    t = np.linspace(0.01, law.duration - 0.01, count)
    near = np.min(np.abs(t[:, None] - law.times), axis=1)
    return t[near > 0.02]


def rotation(law, t):
    return Rotation.from_quat(law(t), scalar_first=True)


def test_omega_is_the_rate_of_the_orientation(law):
    """ω = lim log(R(t)ᵀ R(t+h))/h, in body axes, from SciPy's logarithm."""
    t, h = inner_times(law), 1e-5
    turned = (rotation(law, t - h).inv() * rotation(law, t + h)).as_rotvec() / (2 * h)
    np.testing.assert_allclose(law(t, 1), turned, atol=1e-7)


@pytest.mark.parametrize("order", [2, 3])
def test_each_rate_is_the_derivative_of_the_one_before(law, order):
    t, h = inner_times(law), 1e-6
    breaks = np.concatenate([s.start_time + s.duration * s.breaks for s in law.segments])
    t = t[np.min(np.abs(t[:, None] - breaks), axis=1) > 1e-3]
    difference = (law(t + h, order - 1) - law(t - h, order - 1)) / (2 * h)
    np.testing.assert_allclose(law(t, order), difference, atol=2e-5)


def test_nodes_are_hit_and_the_path_is_continuous_on_the_sphere(law, paper):
    visits = paper.orientations.quaternions[list(paper.tour.order)]
    hits = np.abs(np.sum(law(law.times) * visits, axis=1))
    np.testing.assert_allclose(hits, 1, atol=1e-15)
    t = np.linspace(0, law.duration, 3001)
    q = law(t)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-15)
    assert np.min(np.sum(q[1:] * q[:-1], axis=1)) > 0.999


def test_matrices(law):
    t = inner_times(law, 11)
    np.testing.assert_allclose(law.rotation(t), rotation(law, t).as_matrix(), atol=1e-15)
    np.testing.assert_allclose(law.direction_cosines(t)[3], law.rotation(t[3]).T, atol=0)


def test_scalars_arrays_and_shapes(law):
    assert law(1.0).shape == (4,)
    assert law(np.ones((2, 3)), 2).shape == (2, 3, 3)
    assert law.rotation(np.ones(5)).shape == (5, 3, 3)
    np.testing.assert_array_equal(law([0.5, 1.5])[1], law(1.5))


def test_sides_of_a_node(paper):
    law = paper.optimised.law
    node = law.times[1]
    np.testing.assert_allclose(law(node, 3, "left"), law.segments[0](np.array([1.0]), 3, "left")[0])
    np.testing.assert_allclose(law(node, 3, "right"), law.segments[1](np.array([0.0]), 3, "right")[0])
    assert np.linalg.norm(law(node, 3, "left") - law(node, 3, "right")) > 1
    np.testing.assert_array_equal(law(law.duration, 3), law(law.duration, 3, "left"))


@pytest.mark.parametrize("t", [-1e-9, 1e9, np.nan])
def test_times_outside_are_refused(law, t):
    with pytest.raises(ValueError, match="time outside"):
        law(t)


def test_orders_that_are_not_there_are_refused(law):
    with pytest.raises(ValueError, match="order 5"):
        law(0.0, 5)


def test_the_effort_is_the_integral_of_the_squares(law):
    edges = np.unique(np.concatenate([s.start_time + s.duration * s.breaks for s in law.segments]))
    for order in (2, 3):
        total = 0.0
        for a, b in pairwise(edges):
            t = a + (b - a) * (np.arange(400) + 0.5) / 400
            total += np.mean(np.sum(law(t, order) ** 2, axis=1)) * (b - a)
        assert effort(law, order) == pytest.approx(total, rel=1e-4)


def test_the_quintics_effort_in_closed_form(paper):
    """∫jerk² dt = 720 θ²/T⁵ on each leg, ∫α² dt = 120/7 θ²/T³."""
    law = next(b.law for b in paper.baselines if b.name == "quintic")
    theta, duration = 2 * np.pi / 3, 3.75
    assert effort(law, 3) == pytest.approx(11 * 720 * theta**2 / duration**5, rel=1e-9)
    assert effort(law, 2) == pytest.approx(11 * 120 / 7 * theta**2 / duration**3, rel=1e-9)


def test_time_laws_know_the_route_parameter_only(paper):
    time_law = TimeLaw("test", time_double_s(paper.route, paper.requirements).timings)
    np.testing.assert_allclose(time_law(time_law.times), range(12), atol=1e-12)
    t = np.linspace(0, time_law.duration, 77)
    law = next(b.law for b in paper.baselines if b.name == "double-S")
    np.testing.assert_allclose(paper.route.orientation(time_law(t)), law(t), atol=1e-14)
    speed = np.linalg.norm(law(t, 1), axis=1)
    np.testing.assert_allclose(time_law(t, 1) * 2 * np.pi / 3, speed, atol=1e-12)


def test_baselines_take_their_closed_form_times(paper):
    assert time_quintic(paper.requirements).duration == pytest.approx(41.25, rel=1e-10)
    assert time_double_s(paper.route, paper.requirements).duration == pytest.approx(27.6, rel=1e-10)
    assert time_double_s(paper.route, paper.requirements, stop=True).duration == pytest.approx(
        29.7, rel=1e-10
    )
    assert find_route_limit(paper.route, paper.requirements) == pytest.approx(27.6, rel=1e-14)


def test_without_straight_nodes_there_is_one_double_s():
    names = [entry.name for entry in reference("imu-calibration-120-cell").laws]
    assert names == ["optimised", "quintic", "double-S"]
