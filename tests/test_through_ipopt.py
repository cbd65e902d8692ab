"""The search against IPOPT on the same program, written down once more: node states, one sextic a leg."""

import casadi as ca
import numpy as np
import pytest

from timelaw.least_time.double_s import double_s_time
from timelaw.numerics.bernstein import basis_matrix
from timelaw.numerics.quaternion import normalise
from timelaw.through.ladder import Form, Stretch, climb
from timelaw.through.measures import find_use, list_limit_measures

BOUNDS = np.radians([60, 120, 600])
PLACES = np.linspace(0, 1, 31)


def multiply(p, q):
    w, v = p[0] * q[0] - ca.dot(p[1:], q[1:]), p[0] * q[1:] + q[0] * p[1:] + ca.cross(p[1:], q[1:])
    return ca.vertcat(w, v)


def turn(a, b):
    """Vec(ā b)."""
    return a[0] * b[1:] - b[0] * a[1:] - ca.cross(a[1:], b[1:])


def list_ends(q, omega, alpha, h):
    """The first three control points of a sextic from a knot, or with -ω the last ones."""
    q = ca.DM(q)
    v = multiply(q, ca.vertcat(0, omega / 2))
    a = multiply(q, ca.vertcat(-ca.dot(omega, omega) / 4, alpha / 2))
    return [q, q + h * v / 6, q + h * v / 3 + h**2 * a / 30]


def solve(nodes, curve):
    """The least time that IPOPT finds from a curve."""
    legs = len(nodes) - 1
    omega = [ca.SX.sym(f"w{k}", 3) for k in range(legs - 1)]
    alpha = [ca.SX.sym(f"a{k}", 3) for k in range(legs - 1)]
    h, rho = ca.SX.sym("h", legs), ca.SX.sym("r", legs)
    inner = [ca.SX.sym(f"c{k}", 3) for k in range(legs)]
    still = ca.SX.zeros(3, 1)
    rates = [(still, still), *zip(omega, alpha, strict=True), (still, still)]
    rows = []
    for k in range(legs):
        left = list_ends(nodes[k], *rates[k], h[k])
        right = list_ends(nodes[k + 1], -rates[k + 1][0], rates[k + 1][1], h[k])
        middle = ca.DM(normalise(nodes[k] + nodes[k + 1]))
        points = [*left, multiply(middle, ca.vertcat(1 + rho[k], inner[k])), *right[::-1]]
        control = ca.horzcat(*points)
        for u in PLACES:
            q, v, a, j = (control @ ca.DM(basis_matrix(6, [u], i)[0]) for i in range(4))
            d = ca.dot(q, q)
            r, s = 2 * ca.dot(q, v) / d, 2 * (ca.dot(v, v) + ca.dot(q, a)) / d
            w = 2 * turn(q, v) / d
            al = 2 * turn(q, a) / d - r * w
            je = 2 * (turn(q, j) + turn(v, a)) / d - 2 * r * al - s * w
            rows += [
                ca.dot(x, x) / (b * h[k] ** n) ** 2
                for n, (x, b) in enumerate(zip((w, al, je), BOUNDS, strict=True), 1)
            ]
    variables = ca.vertcat(*omega, *alpha, h, rho, *inner)
    solver = ca.nlpsol(
        "s",
        "ipopt",
        {"x": variables, "f": ca.sum1(h), "g": ca.vertcat(*rows)},
        {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.max_iter": 300},
    )
    inside = slice(1, -1)
    start = [curve.rates[inside, 0], curve.rates[inside, 1], curve.duration, curve.weight, curve.inner[:, 0]]
    least = np.full(variables.shape[0], -np.inf)
    counts = 6 * (legs - 1)
    least[counts : counts + legs], least[counts + legs : counts + 2 * legs] = 1e-3, -0.5
    most = np.full(len(least), np.inf)
    most[counts + legs : counts + 2 * legs] = 3.0
    found = solver(x0=np.concatenate([part.ravel() for part in start]), lbx=least, ubx=most, lbg=0, ubg=1)
    assert solver.stats()["success"]
    return float(found["f"])


@pytest.mark.parametrize("seed", range(2))
def test_the_search_ends_where_ipopt_does(seed):
    rng = np.random.default_rng(seed)
    nodes = normalise(rng.normal(size=(4, 4)))
    nodes[1:] *= np.cumprod(np.sign(np.sum(nodes[1:] * nodes[:-1], axis=1)))[:, None]
    angles = 2 * np.arccos(np.sum(nodes[1:] * nodes[:-1], axis=1))
    given = dict(zip(("velocity", "acceleration", "jerk"), BOUNDS.tolist(), strict=True))
    limits = list_limit_measures(given, [{}] * (len(nodes) - 1))
    stops = np.array([double_s_time(angle, *BOUNDS) for angle in angles])
    curve, _ = climb(Stretch(nodes, angles, stops), limits, Form(2, pieces=1))
    assert find_use(curve, limits, 1001).worst <= 1 + 1e-6
    assert curve.total == pytest.approx(solve(nodes, curve), rel=1e-3)
    rough = curve.stretched(1.3)
    assert curve.total <= solve(nodes, rough) * (1 + 1e-3)
