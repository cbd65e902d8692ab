"""Quaternion algebra: group axioms, and SciPy's rotations as the oracle."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from timelaw.numerics import quaternion as quat

DANGEROUS_ANGLES = [0.0, 1e-12, 1e-8, 1e-3, 1.0, np.pi - 1e-8, np.pi, np.pi + 1e-8, 2 * np.pi - 1e-9]


@st.composite
def unit(draw):
    q = np.array(draw(st.lists(st.floats(-1, 1), min_size=4, max_size=4)))
    norm = np.linalg.norm(q)
    return q / norm if norm > 1e-3 else np.array([1.0, 0, 0, 0])


def scipy_rotation(q):
    return Rotation.from_quat(q, scalar_first=True)


@given(unit(), unit(), unit())
def test_the_product_is_associative_and_matches_scipy(p, q, r):
    left, right = quat.multiply(quat.multiply(p, q), r), quat.multiply(p, quat.multiply(q, r))
    np.testing.assert_allclose(left, right, atol=1e-15)
    expected = (scipy_rotation(p) * scipy_rotation(q)).as_matrix()
    np.testing.assert_allclose(quat.rotation_matrix(quat.multiply(p, q)), expected, atol=1e-14)


@given(unit())
def test_the_conjugate_inverts_and_both_signs_are_one_orientation(q):
    np.testing.assert_allclose(quat.multiply(q, quat.conjugate(q)), [1, 0, 0, 0], atol=1e-15)
    np.testing.assert_allclose(quat.rotation_matrix(q), quat.rotation_matrix(-q), atol=0)
    assert quat.angle_between(q, -q) == pytest.approx(0, abs=1e-15)


def test_units_multiply_as_hamilton_wrote():
    i, j, k = np.eye(4)[1:]
    np.testing.assert_array_equal(quat.multiply(i, j), k)
    np.testing.assert_array_equal(quat.multiply(i, i), [-1, 0, 0, 0])


@pytest.mark.parametrize("angle", DANGEROUS_ANGLES)
def test_axis_angle_is_active_and_the_angle_comes_back(angle):
    axis = np.array([2.0, -1.0, 2.0]) / 3
    q = quat.from_axis_angle(axis, angle)
    np.testing.assert_allclose(
        quat.rotation_matrix(q), Rotation.from_rotvec(angle * axis).as_matrix(), atol=1e-15
    )
    between = quat.angle_between(np.array([1.0, 0, 0, 0]), q)
    assert between == pytest.approx(min(angle, 2 * np.pi - angle), rel=1e-12, abs=1e-15)


def test_a_quarter_turn_about_z_takes_x_to_y():
    q = quat.from_axis_angle([0, 0, 1], np.pi / 2)
    np.testing.assert_allclose(quat.rotation_matrix(q) @ [1, 0, 0], [0, 1, 0], atol=1e-15)
