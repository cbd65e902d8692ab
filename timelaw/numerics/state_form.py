"""Polynomials in state form: values and derivatives at the start, and control points of the next derivative.

Stacks of p pieces: durations (p,), states (p, c+1), controls (p, m+1) of the (c+1)-th derivative.
"""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import UNIT_ROUNDOFF


def derive(durations: Array, states: Array, controls: Array, order: int) -> tuple[Array, Array]:
    """Control points (p, n+1) of the k-th derivative over each piece, and a bound (p,) on their rounding."""
    control, error = controls, np.zeros(len(controls))
    for level in range(states.shape[1] - 1, order - 1, -1):
        control, error = _integrate(control, error, states[:, level], durations)
    for _ in range(order - states.shape[1]):
        control, error = _differentiate(control, error, durations)
    return control, error


def _integrate(control: Array, error: Array, start: Array, durations: Array) -> tuple[Array, Array]:
    """C_0 = start, C_j = C_(j-1) + h c_(j-1)/(n+1).

    A running sum of n + 2 terms errs by less than n + 2 roundoffs of the sum of their sizes, each term by
    two of its own; twice that is taken.
    """
    n = control.shape[1] - 1
    steps = control * (durations / (n + 1))[:, None]
    sums = np.cumsum(np.concatenate([start[:, None], steps], axis=1), axis=1)
    size = np.abs(start) + np.sum(np.abs(steps), axis=1)
    return sums, error * durations * (1 + 4 * UNIT_ROUNDOFF) + 2 * (n + 4) * UNIT_ROUNDOFF * size


def _differentiate(control: Array, error: Array, durations: Array) -> tuple[Array, Array]:
    """N (c_(j+1) - c_j)/h, of degree 0 where there is nothing left."""
    n = control.shape[1] - 1
    if not n:
        return np.zeros_like(control), np.zeros_like(error)
    steps = np.diff(control, axis=1) * (n / durations)[:, None]
    size = np.max(np.abs(steps), axis=1)
    return steps, error * (2 * n / durations) * (1 + 4 * UNIT_ROUNDOFF) + 6 * UNIT_ROUNDOFF * size
