"""Uniform sets by covering radius: a lattice where one is fine enough, else a super-Fibonacci spiral.

Spirals on S³ (Alexa, CVPR 2022): q_i = (√(s/n) sin α, √(s/n) cos α, √(1 - s/n) sin β, √(1 - s/n) cos β),
s = i + ½, α = 2πs/√2, β = 2πs/ψ, ψ⁴ = ψ + 4. The covering radius is measured on the set itself, not
taken from a formula.
"""

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.orientations.lattices import LATTICES, make_lattice
from timelaw.orientations.spread import measure_covering_radius

MOST_ORIENTATIONS = 5000
PSI = 1.533751168755204288118041  # the root > 1 of x⁴ = x + 4
NEEDED = 60.0  # n ρ³ of the finest spirals, measured: 64 to 80 for ρ of 15° to 60°
STEP = 1.02  # sets grow by this factor until one is fine enough
ROUNDING = 1e-9  # of the covering radius: 90° is what the 24-cell has


def make_spiral(count: int) -> Array:
    """`count` orientations (count, 4) along a spiral."""
    s = np.arange(count) + 0.5
    inner, outer = np.sqrt(s / count), np.sqrt(1 - s / count)
    alpha, beta = 2 * np.pi * s / np.sqrt(2), 2 * np.pi * s / PSI
    return np.stack(
        [inner * np.sin(alpha), inner * np.cos(alpha), outer * np.sin(beta), outer * np.cos(beta)], axis=1
    )


def make_uniform(fill: float) -> tuple[Array, str | None]:
    """A set whose covering radius is at most `fill` [rad], and the lattice's name if it is one.

    The smallest of the lattices that do, otherwise the first spiral in a growing series.

    Raises:
        InputError: it needs too many orientations.
    """
    for name in LATTICES:  # in the order of their sizes
        if measure_covering_radius(points := make_lattice(name)) <= fill * (1 + ROUNDING):
            return points, name
    count = int(NEEDED / fill**3)
    while count <= MOST_ORIENTATIONS:
        points = make_spiral(count)
        if measure_covering_radius(points) <= fill:
            return points, None
        count = max(count + 1, int(count * STEP))
    reached = np.degrees(measure_covering_radius(make_spiral(MOST_ORIENTATIONS)))
    needed = f"{np.degrees(fill):.4g}° needs more than {MOST_ORIENTATIONS} orientations"
    message = f"{needed}, which reach {reached:.2f}°"
    raise InputError(Fault(message, "route.orientations.uniform.fill"))
