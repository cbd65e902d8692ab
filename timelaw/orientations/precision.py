"""How precisely orientations are written, as their numbers show: digits, norms, single precision.

Quaternions and matrices hold more numbers than an orientation has freedoms, so that what was rounded shows
in norms, or in RᵀR, that are off. Angles show nothing: they are taken as they stand.
"""

from collections.abc import Callable
from dataclasses import dataclass
from decimal import Decimal
from math import sqrt

import numpy as np

from timelaw.numerics.array import Array

DOUBLES = 1e-14  # rad; some tens of roundings, as many as a product of a few rotations has
ROUGH = 2e-15  # misfit above which numbers are not those of doubles that were reckoned with care
BEYOND = 3.0  # norms are off by a part of what rounding does across; the largest of a few by a third at least
LARGE = 0.1  # numbers from here on show all decimals, also where significant digits were counted
SINGLE_DIGITS = 8  # decimals from which numbers can be those of single precision; fewer are coarser


@dataclass(frozen=True)
class Precision:
    """The body's turn [rad] by which an orientation may differ from what was meant, and how that is known."""

    angle: float
    origin: str


EXACT = Precision(DOUBLES, "exact to the rounding of doubles")


@dataclass(frozen=True)
class Redundancy:
    """What the numbers of a form have to satisfy, and what errors (N, width) of theirs do to that.

    `misfit` of rows (N, width) → (N,): by how much they fail. `explained`, rows and errors → (N,): the
    largest misfit such errors make. `turn`, errors → (N,): the largest turn of the body [rad].
    """

    name: str
    misfit: Callable[[Array], Array]
    explained: Callable[[Array, Array], Array]
    turn: Callable[[Array], Array]


def _norm_misfit(rows: Array) -> Array:
    return np.asarray(np.abs(np.sqrt(np.sum(rows**2, axis=1)) - 1))


def _product_misfit(rows: Array) -> Array:
    """The largest entry of |RᵀR - 1|."""
    matrices = rows.reshape(-1, 3, 3)
    products = np.swapaxes(matrices, 1, 2) @ matrices
    return np.asarray(np.max(np.abs(products - np.eye(3)), axis=(1, 2)))


QUATERNIONS = Redundancy(
    "quaternions",
    _norm_misfit,
    lambda rows, errors: np.sum(np.abs(rows) * errors, axis=1) + np.sum(errors**2, axis=1),
    # half the body's turn is |e| at most on what is left of the norm
    lambda errors: 2 * np.sqrt(np.sum(errors**2, axis=1)) / (1 - np.sqrt(np.sum(errors**2, axis=1))),
)
MATRICES = Redundancy(
    "matrices",
    _product_misfit,
    # a column of a rotation has entries that sum up to √3 at most
    lambda _, errors: 2 * sqrt(3) * np.max(errors, axis=1) + 3 * np.max(errors, axis=1) ** 2,
    # the antisymmetric part of RᵀE has a norm of |E| at most, which is √2 times the turn
    lambda errors: np.sqrt(np.sum(errors**2, axis=1) / 2),
)


def take_as_exact(_: Array) -> Precision:
    """The precision of numbers that show none: that of doubles."""
    return EXACT


def measure_precision(rows: Array, form: Redundancy) -> Precision:
    """The precision of a table (N, width) of quaternions or matrices, that of its coarsest rows.

    Exact where no row fails to satisfy what it should. Otherwise the rows that do were rounded, to the
    decimals of the longest number among them, or to single precision; if that does not explain how
    far off some of them are, these were rounded to fewer decimals, or are off for another reason.
    """
    rows = rows[form.misfit(rows) > ROUGH]
    if not len(rows):
        return EXACT
    decimals = np.array([[_count_decimals(value) for value in row] for row in rows.tolist()], dtype=int)
    shown = np.array([_row_decimals(row, counts) for row, counts in zip(rows, decimals, strict=True)])
    level = int(np.max(shown))
    if level >= SINGLE_DIGITS and _is_single(rows, decimals):
        half = np.spacing(np.abs(rows).astype(np.float32)).astype(float) / 2
        errors = half + np.minimum(half, 0.5 * 10.0**-decimals)  # rounded twice: stored, and written
        rough = form.misfit(rows) > form.explained(rows, errors) + ROUGH
        if not np.any(rough):
            return _precision(form.turn(errors), f"{form.name} in single precision")
        rows, shown = rows[rough], shown[rough]
        level = int(np.max(shown))
    while True:
        errors = np.full(rows.shape, 0.5 * 10.0**-level)
        rough = form.misfit(rows) > form.explained(rows, errors) + ROUGH
        if not np.any(rough):
            return _precision(form.turn(errors), f"{form.name} with {level} digits")
        rows, shown = rows[rough], shown[rough]
        coarser = int(np.max(shown))
        if coarser >= level:
            off = np.max(form.misfit(rows))
            what = f"{form.name} whose norms are off by up to {off:.1g}"
            return _precision(form.turn(np.full((1, 1), BEYOND * off)), what)
        level = coarser


def _precision(turns: Array, origin: str) -> Precision:
    return Precision(max(float(np.max(turns)), DOUBLES), origin)


def _count_decimals(value: float) -> int:
    """Decimals of the shortest text that reads back as this double; 0 for whole numbers."""
    exponent = Decimal(repr(value)).normalize().as_tuple().exponent
    return max(-int(exponent), 0)


def _row_decimals(row: Array, decimals: Array) -> int:
    """The decimals to which a row was rounded: those of its longest number.

    Of large numbers, if one has any: small ones have more where significant digits were written.
    """
    large = decimals[(np.abs(row) >= LARGE) & (decimals > 0)]
    return int(np.max(large if len(large) else decimals))


def _is_single(rows: Array, decimals: Array) -> bool:
    """Whether all numbers are those of single precision, written in full or to their own decimals."""
    return all(
        value == (single := float(np.float32(value))) or value == round(single, int(count))
        for value, count in zip(rows.ravel().tolist(), decimals.ravel().tolist(), strict=True)
    )
