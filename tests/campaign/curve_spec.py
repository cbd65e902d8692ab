"""Bézier curves of a problem file as the judge reads them, and what of them is true whatever the time."""

from dataclasses import dataclass
from math import comb, factorial

import numpy as np
from scipy.spatial.transform import Rotation

from tests.campaign.attitude import about, apart, product
from tests.campaign.spec import DEGREE, number

SIGNED = ("wxyz", "xyzw")
RIGHT_ANGLE = 1e-9  # of the product of quaternions of which neither sign is the nearer
GRID = 4001
HIGHEST = 3  # derivatives of the path at a joint
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)
STRETCHES = 400


@dataclass(frozen=True)
class Bezier:
    """Control quaternions (n+1, 4) of any length, points (m+1, 3) or none, whether |Q|² divides them."""

    control: np.ndarray
    points: np.ndarray | None
    divided: bool

    def orient(self, u):
        """Quaternions (m, 4), not normalised."""
        return blend(self.control, u)

    def place(self, u):
        """Places (m, 3); zeros of a body that only turns."""
        if self.points is None:
            return np.zeros((len(u), 3))
        found = blend(self.points, u)
        return found / np.sum(self.orient(u) ** 2, axis=1, keepdims=True) if self.divided else found

    def expand(self, u: float) -> np.ndarray:
        """Taylor's coefficients (HIGHEST + 1, 6) of Ω and, along, those of the place's first derivative."""
        q = taylor(self.control, u, HIGHEST + 1)
        square = multiply_series(q, q, np.dot)
        slope = q[1:] * np.arange(1, len(q))[:, None]
        bar = q * np.array([1.0, -1.0, -1.0, -1.0])
        turning = divide_series(
            2 * multiply_series(bar[: len(slope)], slope, lambda a, b: product(a, b)[1:]), square
        )
        if self.points is None:
            return np.hstack([turning, np.zeros_like(turning)])
        p = taylor(self.points, u, HIGHEST + 1)
        place = divide_series(p, square) if self.divided else p
        return np.hstack([turning, place[1:] * np.arange(1, len(place))[:, None]])

    def lengths(self) -> tuple[float, float]:
        """∫|Ω| du and ∫|c'| du."""
        u = ((np.arange(STRETCHES)[:, None] + (NODES + 1) / 2) / STRETCHES).ravel()
        weights = np.tile(WEIGHTS / 2 / STRETCHES, STRETCHES)
        rates = self.rates(u)
        return tuple(
            float(weights @ np.linalg.norm(rates[:, part], axis=1)) for part in (slice(0, 3), slice(3, 6))
        )

    def rates(self, u) -> np.ndarray:
        """Ω and the place's derivative (m, 6)."""
        q, slope = blend(self.control, u), blend(differences(self.control), u)
        square = np.sum(q * q, axis=1, keepdims=True)
        turning = 2 * product(q * np.array([1.0, -1.0, -1.0, -1.0]), slope)[:, 1:] / square
        if self.points is None:
            return np.hstack([turning, np.zeros_like(turning)])
        moved = blend(differences(self.points), u)
        if self.divided:
            fall = 2 * np.sum(q * slope, axis=1, keepdims=True)
            moved = (moved - self.place(u) * fall) / square
        return np.hstack([turning, moved])

    @property
    def thinness(self) -> float:
        """The least |Q|² in parts of the largest."""
        square = np.sum(self.orient(np.linspace(0, 1, GRID)) ** 2, axis=1)
        return float(np.min(square) / np.max(square))


def blend(control, u):
    """Σ B_i(u) c_i (m, k)."""
    n, u = len(control) - 1, np.asarray(u, dtype=float)[:, None]
    return sum(comb(n, i) * u**i * (1 - u) ** (n - i) * control[i] for i in range(n + 1))


def differences(control):
    """Control points of the derivative in u."""
    return (len(control) - 1) * np.diff(control, axis=0) if len(control) > 1 else np.zeros_like(control)


def taylor(control, u: float, order: int) -> np.ndarray:
    """The k-th derivatives over k! at u (order + 1, ·)."""
    found, rows = [], np.array(control)
    for k in range(order + 1):
        found.append(blend(rows, np.array([u]))[0] / factorial(k))
        rows = differences(rows)
    return np.array(found)


def multiply_series(a, b, times) -> np.ndarray:
    """Product of series, as many terms as the shorter has."""
    count = min(len(a), len(b))
    return np.array([sum(times(a[i], b[k - i]) for i in range(k + 1)) for k in range(count)])


def divide_series(a, b) -> np.ndarray:
    """Series of vectors over one of numbers."""
    found: list[np.ndarray] = []
    for k in range(len(a)):
        found.append((a[k] - sum((found[i] * b[k - i] for i in range(k)), np.zeros_like(a[k]))) / b[0])
    return np.array(found)


def read_curves(data: dict) -> list[Bezier]:
    """The curves of a problem; of two that meet within 1e-6 the second begins where the first ends."""
    return [_read_curve(given) for given in data["route"]["bezier"]]


def _read_curve(given: dict) -> Bezier:
    form, rows = given.get("as", "wxyz"), np.array(given["quaternions"], dtype=float)
    factor = DEGREE if given.get("unit") == "deg" else 1.0
    if form == "xyzw":
        q = rows[:, [3, 0, 1, 2]]
    elif form == "rotation-vector":
        q = Rotation.from_rotvec(rows * factor).as_quat(scalar_first=True)
    elif form == "euler":
        q = Rotation.from_euler(given["sequence"], rows * factor).as_quat(scalar_first=True)
    elif form == "matrix":
        q = Rotation.from_matrix(rows.reshape(-1, 3, 3)).as_quat(scalar_first=True)
    elif form == "axis-angle":
        lengths = np.linalg.norm(rows[:, :3], axis=1, keepdims=True)
        q = about(rows[:, :3] / np.where(lengths == 0, 1, lengths), rows[:, 3] * factor)
    else:
        q = rows
    q = q / np.linalg.norm(q, axis=1, keepdims=True)
    if form not in SIGNED:
        for k in range(1, len(q)):
            q[k] *= -1.0 if q[k - 1] @ q[k] < -RIGHT_ANGLE else 1.0
    q = q * np.array(given.get("weights", np.ones(len(q))), dtype=float)[:, None]
    points = given.get("points")
    if points is not None:
        points = np.array([[number(x) for x in row] for row in points])
    return Bezier(q, points, given.get("translation", "divided") == "divided")


def measure_gap(before: Bezier, after: Bezier) -> tuple[float, float]:
    """Between the end of one and the start of the other: rad, and m over the farthest point."""
    one, zero = np.array([1.0]), np.array([0.0])
    angle = float(apart(*(c / np.linalg.norm(c) for c in (before.control[-1], after.control[0]))))
    if before.points is None or after.points is None:
        return angle, 0.0
    farthest = max(float(np.max(np.abs(c.points))) for c in (before, after)) or 1.0
    return angle, float(np.linalg.norm(after.place(zero) - before.place(one))) / farthest


SAME, OTHER = 1e-12, 1e-8  # relative: alike below the one, not above the other, unsure between
NOTHING = 1e-12
SLOW = 1e-5  # of the fastest along the curve: too near to no direction at all to be told


def classify(before: Bezier, after: Bezier) -> tuple[range, range]:
    """The classes k of C^k and G^k that a joint may have, up to 3; more than one where it is not sure."""
    fastest = [
        max(
            float(np.max(np.linalg.norm(c.rates(np.linspace(0, 1, 201))[:, part], axis=1)))
            for c in (before, after)
        )
        for part in (slice(0, 3), slice(3, 6))
    ]
    farthest = max(0.0 if c.points is None else float(np.max(np.abs(c.points))) for c in (before, after))
    shown = (NOTHING, NOTHING * farthest)  # of a body that does not turn, or move, there is rounding alone
    weights = np.repeat(
        [1 / size if size > least else 0.0 for size, least in zip(fastest, shown, strict=True)], 3
    )
    x, y = (c.expand(u) * weights * np.array([1, 1, 2, 6])[:, None] for c, u in ((before, 1.0), (after, 0.0)))
    x, y = x[:HIGHEST], y[:HIGHEST]
    parametric = _count(
        [float(np.linalg.norm(a - b)) / max(1.0, float(np.linalg.norm(a))) for a, b in zip(x, y, strict=True)]
    )
    size = float(np.linalg.norm(x[0]))
    if min(size, float(np.linalg.norm(y[0]))) < SLOW:
        return parametric, range(parametric.start, HIGHEST + 1)
    geometric = _count(_reparametrise(x, y))
    return parametric, range(max(parametric.start, geometric.start), max(parametric.stop, geometric.stop))


def _reparametrise(x, y) -> list[float]:
    """What is left of each derivative of the first curve when the second is run through another way."""
    base = y[0] @ y[0]
    size = float(np.linalg.norm(x[0]))
    first = float(x[0] @ y[0] / base)
    left = [float(np.linalg.norm(x[0] - first * y[0])) / size if first > 0 else np.inf]
    rest = x[1] - first**2 * y[1]
    second = float(rest @ y[0] / base)
    left.append(float(np.linalg.norm(rest - second * y[0])) / max(float(np.linalg.norm(x[1])), size**2))
    rest = x[2] - first**3 * y[2] - 3 * first * second * y[1]
    third = float(rest @ y[0] / base)
    left.append(float(np.linalg.norm(rest - third * y[0])) / max(float(np.linalg.norm(x[2])), size**3))
    return left


def _count(left: list[float]) -> range:
    """How many leading ones vanish: surely, and perhaps."""
    sure = next((k for k, one in enumerate(left) if not one <= SAME), len(left))
    perhaps = next((k for k, one in enumerate(left) if not one <= OTHER), len(left))
    return range(sure, perhaps + 1)
