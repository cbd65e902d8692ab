"""The public algebra: the axioms, on hypothesis' examples, and SciPy's rotations."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation, Slerp

from timelaw import quaternion as algebra

NUMBERS = st.floats(-4, 4).map(lambda x: round(x, 6))
ANY = st.lists(NUMBERS, min_size=4, max_size=4).map(np.array)
NONZERO = ANY.filter(lambda q: np.linalg.norm(q) > 1e-3)
UNIT = NONZERO.map(lambda q: q / np.linalg.norm(q))
AXIS = st.lists(NUMBERS, min_size=3, max_size=3).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-3)
RNG = np.random.default_rng(7)
MANY = RNG.normal(size=(5, 3, 4))


def near(a, b, atol=1e-12):
    np.testing.assert_allclose(a, b, rtol=1e-12, atol=atol)


@given(ANY, ANY, ANY, NUMBERS)
def test_it_is_an_algebra(p, q, r, s):
    near(algebra.product(algebra.product(p, q), r), algebra.product(p, algebra.product(q, r)))
    near(algebra.product(p, q + r), algebra.product(p, q) + algebra.product(p, r))
    near(algebra.product(p + q, r), algebra.product(p, r) + algebra.product(q, r))
    near(algebra.product(s * p, q), s * algebra.product(p, q))
    near(
        algebra.conjugate(algebra.product(p, q)), algebra.product(algebra.conjugate(q), algebra.conjugate(p))
    )
    near(algebra.norm(algebra.product(p, q)), algebra.norm(p) * algebra.norm(q))
    near(algebra.product(p, algebra.conjugate(p)), [algebra.norm(p) ** 2, 0, 0, 0])


def test_units_are_hamiltons():
    one, i, j, k = np.eye(4)
    for unit in (i, j, k):
        near(algebra.product(unit, unit), -one)
    near(algebra.product(i, j), k)
    near(algebra.product(j, k), i)
    near(algebra.product(k, i), j)
    near(algebra.product(j, i), -k)


@given(NONZERO, NONZERO)
def test_inverses_undo(p, q):
    near(algebra.product(q, algebra.inverse(q)), [1, 0, 0, 0])
    near(algebra.product(algebra.inverse(q), q), [1, 0, 0, 0])
    scale = 1 / (algebra.norm(p) * algebra.norm(q))
    near(
        algebra.inverse(algebra.product(p, q)) / scale,
        algebra.product(algebra.inverse(q), algebra.inverse(p)) / scale,
    )


@given(ANY, ANY)
def test_real_matrices_turn_products_into_matrix_products(p, q):
    near(algebra.left_matrix(p) @ q, algebra.product(p, q))
    near(algebra.right_matrix(q) @ p, algebra.product(p, q))
    near(algebra.left_matrix(algebra.product(p, q)), algebra.left_matrix(p) @ algebra.left_matrix(q))
    near(algebra.right_matrix(algebra.product(p, q)), algebra.right_matrix(q) @ algebra.right_matrix(p))
    near(algebra.left_matrix(algebra.conjugate(p)), algebra.left_matrix(p).T)
    near(np.linalg.det(algebra.left_matrix(p)), algebra.norm(p) ** 4, atol=1e-9)


@given(ANY, ANY)
def test_pairs_of_complex_numbers_multiply_as_cayley_and_dickson_say(p, q):
    (a, b), (c, d) = algebra.to_complex_pair(p), algebra.to_complex_pair(q)
    near(algebra.from_complex_pair(a * c - b * np.conj(d), a * d + b * np.conj(c)), algebra.product(p, q))
    near(algebra.from_complex_pair(a, b), p, atol=0)
    near(abs(a) ** 2 + abs(b) ** 2, algebra.norm(p) ** 2)


@given(AXIS, st.floats(-7, 7), AXIS)
def test_eulers_formula_turns_by_the_whole_angle_about_its_unit(axis, angle, v):
    u = axis / np.linalg.norm(axis)
    near(algebra.exp_of_unit(u, angle), algebra.exp(np.concatenate([[0.0], angle * u])), atol=1e-14)
    half = algebra.exp_of_unit(u, angle / 2)
    sandwich = algebra.product(
        algebra.product(half, np.concatenate([[0.0], v])), algebra.exp_of_unit(u, -angle / 2)
    )
    expected = Rotation.from_rotvec(angle * u).apply(v)
    near(sandwich, [0.0, *expected])
    near(algebra.rotate(half, v), expected)


@given(ANY)
def test_the_exponential_is_that_of_the_matrices(q):
    near(algebra.exp(q), expm(algebra.left_matrix(q))[:, 0], atol=1e-10)


@given(NONZERO)
def test_the_logarithm_is_undone_by_the_exponential(q):
    near(algebra.exp(algebra.log(q)), q)
    assert np.linalg.norm(algebra.log(q)[1:]) <= np.pi + 1e-15


@given(NONZERO, st.floats(-3, 3), st.floats(-3, 3))
def test_powers_add_up(q, s, t):
    near(
        algebra.product(algebra.power(q, s), algebra.power(q, t)) / algebra.norm(q) ** (s + t),
        algebra.power(q, s + t) / algebra.norm(q) ** (s + t),
    )
    near(algebra.power(q, 1), q)
    near(algebra.power(q, 2), algebra.product(q, q))
    near(algebra.power(q, -1) * algebra.norm(q), algebra.inverse(q) * algebra.norm(q))


@pytest.mark.parametrize("angle", [0.0, 1e-200, 1e-12, 1e-8, 1.0, np.pi - 1e-9, np.pi])
def test_small_and_half_turns_lose_nothing(angle):
    q = algebra.exp([0.0, 0.0, angle, 0.0])
    near(algebra.log(q), [0, 0, angle, 0], atol=1e-15)


def test_minus_one_has_a_logarithm_too():
    near(algebra.log([-1.0, 0, 0, 0]), [0, np.pi, 0, 0])


@given(NONZERO, UNIT)
def test_the_kinematic_map_is_scipys_and_its_inverse_finds_the_pair(q, p):
    near(algebra.to_matrix(q), Rotation.from_quat(q, scalar_first=True).as_matrix())
    found = algebra.from_matrix(algebra.to_matrix(p))
    near(min((found, -found), key=lambda x: np.linalg.norm(x - p)), p, atol=1e-14)
    assert found[0] >= 0


@pytest.mark.parametrize(
    "q", [*np.eye(4), [1e-9, 1, 0, 0], [1e-9, 0, 1, 1e-9], [0, 0.6, 0.8, 0], [1e-8, 0, 0, -1]]
)
def test_the_inverse_takes_the_row_that_is_not_zero(q):
    """Near half-turns three of the four ratios are 0 : 0 : 0 : 0 or close to it."""
    q = np.array(q) / np.linalg.norm(q)
    found = algebra.from_matrix(algebra.to_matrix(q))
    near(found * np.sign(found @ q), q, atol=3e-16)


def test_the_printed_matrix_is_wrong_in_one_entry():
    """[HZ2019]: with q0 q2 in entry (3, 2) the matrix is no rotation."""
    q = np.array([0.5, 0.1, -0.7, 0.2]) / np.linalg.norm([0.5, 0.1, -0.7, 0.2])
    printed = algebra.to_matrix(q)
    printed[2, 1] = 2 * (q[2] * q[3] + q[0] * q[2])
    with pytest.raises(ValueError, match="not a rotation matrix"):
        algebra.from_matrix(printed)


@given(UNIT, UNIT, st.floats(0, 1))
def test_slerp_is_scipys_along_the_shorter_way(p, q, u):
    if abs(p @ q) < 1e-6:
        return  # a half-turn has two ways
    key = Rotation.from_quat([p, q], scalar_first=True)
    expected = Slerp([0, 1], key)(u).as_matrix()
    near(algebra.to_matrix(algebra.slerp(p, q, u)), expected, atol=1e-9)


def test_later_turns_stand_on_the_left():
    first, later = algebra.exp_of_unit([0, 0, 1], np.pi / 4), algebra.exp_of_unit([1, 0, 0], np.pi / 4)
    near(
        algebra.rotate(algebra.product(later, first), [1, 0, 0]), [0, 0, 1]
    )  # about z to y, then about x to z


def test_arrays_everywhere():
    p, q = MANY, MANY[::-1]
    for function in (
        algebra.conjugate,
        algebra.inverse,
        algebra.exp,
        algebra.log,
        algebra.normalise,
        algebra.to_matrix,
        algebra.left_matrix,
        algebra.right_matrix,
    ):
        found = function(p)
        assert found.shape[:2] == (5, 3)
        near(found[2, 1], function(p[2, 1]))
    near(algebra.product(p, q)[4, 2], algebra.product(p[4, 2], q[4, 2]))
    near(algebra.product(p, q[0, 0])[1, 1], algebra.product(p[1, 1], q[0, 0]))
    u = np.linspace(0, 1, 7)[:, None, None]
    assert algebra.slerp(p, q, u).shape == (7, 5, 3, 4)
    assert algebra.power(p, u).shape == (7, 5, 3, 4)
    assert algebra.from_matrix(algebra.to_matrix(p)).shape == (5, 3, 4)
    assert algebra.rotate(p, [1.0, 0, 0]).shape == (5, 3, 3)
    assert algebra.exp_of_unit([1, 0, 0], u).shape == (7, 1, 1, 4)
    a, b = algebra.to_complex_pair(p)
    near(algebra.from_complex_pair(a, b), p)
    assert algebra.norm(p).shape == (5, 3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: algebra.inverse([0, 0, 0, 0]), "other than zero"),
        (lambda: algebra.log(np.zeros((3, 4))), "other than zero"),
        (lambda: algebra.slerp([0, 0, 0, 0], [1, 0, 0, 0], 0.5), "other than zero"),
        (lambda: algebra.norm([1, 2, 3]), r"quaternions \(\.\.\., 4\) are needed, not \(3,\)"),
        (lambda: algebra.rotate([1, 0, 0, 0], [1, 2]), r"vectors \(\.\.\., 3\) are needed"),
        (lambda: algebra.exp_of_unit([1, 1, 0], 1.0), "a unit imaginary"),
        (lambda: algebra.from_matrix(-np.eye(3)), "determinant is -1"),
        (lambda: algebra.from_matrix(np.full((3, 3), np.nan)), "not a rotation matrix"),
        (lambda: algebra.from_matrix(np.eye(4)), r"matrices \(\.\.\., 3, 3\) are needed"),
    ],
)
def test_what_has_no_meaning_is_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()
