"""Pieces rounded together: exact fractions say that their derivatives agree where they meet."""

from fractions import Fraction
from itertools import pairwise
from math import comb, perm

import numpy as np
import pytest

from tests.curves import split
from timelaw.numerics.composition import compose_control
from timelaw.numerics.joined import round_joined

SEEDS = range(12)


def differ(control, order):
    """Exact n!/(n-k)! Δ^k of the first points."""
    terms = (Fraction(float(control[i])) * comb(order, i) * (-1) ** (order - i) for i in range(order + 1))
    return perm(len(control) - 1, order) * sum(terms)


def find_jumps(pieces, durations, order):
    """Exact jumps of the k-th derivative where pieces meet, columns one after the other."""
    return [
        differ(right[:, c], order) / Fraction(k) ** order
        - (-1) ** order * differ(left[::-1, c], order) / Fraction(h) ** order
        for (left, h), (right, k) in pairwise(zip(pieces, durations, strict=True))
        for c in range(left.shape[1])
    ]


def make_pieces(seed, ratios):
    """One curve of random degree cut where `ratios` say, and the durations of its parts.

    In extended precision: what is cut in doubles jumps already.
    """
    random = np.random.default_rng(seed)
    outer = random.normal(size=(random.integers(4, 8), 3)) * 10.0 ** random.integers(-3, 4)
    inner = np.sort(random.uniform(size=random.integers(5, 9)))
    whole, left = compose_control(outer, inner), np.longdouble(sum(ratios))
    pieces = []
    for ratio in ratios[:-1]:
        first, whole = split(whole, ratio / left)
        pieces.append(first)
        left -= ratio
    return [*pieces, whole], [ratio * 0.375 for ratio in ratios]


@pytest.mark.parametrize("ratios", [(1, 1, 1), (1, 2, 1), (4, 1, 2, 2), (3, 1), (1, 1, 4, 1)])
@pytest.mark.parametrize("seed", SEEDS)
def test_no_derivative_jumps_up_to_the_order(seed, ratios):
    pieces, durations = make_pieces(seed, ratios)
    found = round_joined(pieces, durations, 4)
    for order in range(5):
        assert not any(find_jumps(found, durations, order))
    size = max(np.max(np.abs(piece)) for piece in pieces)
    for piece, rounded in zip(pieces, found, strict=True):
        assert np.max(np.abs(rounded - piece)) <= 2 * 5**4 / 2 * np.spacing(float(size))


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_rounded_one_by_one_jumps(seed):
    """The jumps that are mended are there: without it the test above would show nothing."""
    pieces, durations = make_pieces(seed, (1, 1, 1))
    rounded = [piece.astype(float) for piece in pieces]
    assert any(find_jumps(rounded, durations, 4))


@pytest.mark.parametrize(("ratios", "order"), [((1, 5), 4), ((1, 1.5), 4), ((1, 1.0001), 2), ((1, 1), 40)])
def test_other_ratios_and_low_degrees_are_only_rounded(ratios, order):
    pieces, durations = make_pieces(1, ratios)
    found = round_joined(pieces, durations, order)
    size = max(np.max(np.abs(piece)) for piece in pieces)
    for piece, rounded in zip(pieces, found, strict=True):
        assert np.max(np.abs(rounded - piece)) <= 2 * np.spacing(float(size))
