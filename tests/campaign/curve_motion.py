"""The motion that a law file with rational segments defines, evaluated from its numbers alone."""

from dataclasses import dataclass
from math import comb, factorial

import numpy as np

from tests.campaign.attitude import product

HIGHEST = 4  # rates
BAR = np.array([1.0, -1.0, -1.0, -1.0])


@dataclass(frozen=True)
class Sample:
    """At instants of one piece: times (m,), q (m, 4), rates by order (m, 3), place and its derivatives (m, 3)."""

    segment: int
    time: np.ndarray
    q: np.ndarray
    rates: dict[int, np.ndarray]
    places: dict[int, np.ndarray]


def sample_piece(document: dict, segment: int, piece: int, u: np.ndarray) -> Sample:
    """At the parts u (m,) of a piece."""
    leg = document["segments"][segment]
    given = leg["pieces"][piece]
    before = sum(p["duration"] for p in leg["pieces"][:piece])
    time = leg["start_time"] + before + u * given["duration"]
    q = expand(np.array(given["control"], dtype=float), u, given["duration"], HIGHEST)
    square = convolve(q, q, lambda a, b: np.sum(a * b, axis=-1, keepdims=True))
    slope = [k * part for k, part in enumerate(q)][1:]
    turned = convolve([part * BAR for part in q], slope, lambda a, b: 2 * product(a, b)[..., 1:])
    rates = {k: factorial(k - 1) * part for k, part in enumerate(quotient(turned, square), 1)}
    places = {}
    if "points" in given:
        p = expand(np.array(given["points"], dtype=float), u, given["duration"], HIGHEST)
        places = {k: factorial(k) * part for k, part in enumerate(quotient(p, square))}
    return Sample(segment, time, q[0] / np.linalg.norm(q[0], axis=-1, keepdims=True), rates, places)


def expand(control: np.ndarray, u: np.ndarray, duration: float, order: int) -> list[np.ndarray]:
    """Taylor's coefficients in time at each u, (m, ·) each."""
    found = []
    for k in range(order + 1):
        n = len(control) - 1
        value = sum(comb(n, i) * (u**i * (1 - u) ** (n - i))[:, None] * control[i] for i in range(n + 1))
        found.append(value / factorial(k) / duration**k)
        control = n * np.diff(control, axis=0) if n else np.zeros_like(control)
    return found


def convolve(a: list, b: list, times) -> list[np.ndarray]:
    """Product of series."""
    return [sum(times(a[i], b[k - i]) for i in range(k + 1)) for k in range(min(len(a), len(b)))]


def quotient(a: list, b: list) -> list[np.ndarray]:
    """Series over a series of numbers."""
    found: list[np.ndarray] = []
    for k, value in enumerate(a):
        found.append((value - sum(found[i] * b[k - i] for i in range(k))) / b[0])
    return found
