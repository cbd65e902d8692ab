"""Integrals over [0, 1] that agree with those over halves of the stretches they are made of."""

from collections.abc import Callable
from functools import cache

from flint import arb

NODES = 12
GAP = 1e-5  # of the integral, that halving a stretch may change
HALVINGS = 60
MOST = 256  # stretches at once: what is rounding alone never agrees

Integrands = Callable[[arb], list[arb]]


@cache
def _rule() -> list[tuple[arb, arb]]:
    """Gauss-Legendre nodes and weights on [-1, 1]."""
    return [arb.legendre_p_root(NODES, k, weight=True) for k in range(NODES)]


def _apply(functions: Integrands, middle: arb, radius: arb) -> list[arb]:
    terms = [[weight * value for value in functions(middle + radius * node)] for node, weight in _rule()]
    return [radius * sum(column, arb(0)) for column in zip(*terms, strict=True)]


def integrate(functions: Integrands) -> list[arb]:
    """The integral of each of some functions that are nowhere negative."""
    half = arb(1) / 2
    whole = _apply(functions, half, half)
    found = [arb(0) for _ in whole]
    open_ = [(half, half, whole)]
    for depth in range(HALVINGS + 1):
        halved = []
        for middle, radius, coarse in open_:
            parts = [
                (
                    middle + side * radius / 2,
                    radius / 2,
                    _apply(functions, middle + side * radius / 2, radius / 2),
                )
                for side in (-1, 1)
            ]
            fine = [a + b for a, b in zip(parts[0][2], parts[1][2], strict=True)]
            known = [max(a, b) for a, b in zip(whole, found, strict=True)]
            near = all(abs(a - b).mid() <= GAP * c for a, b, c in zip(coarse, fine, known, strict=True))
            if near or depth == HALVINGS or len(open_) > MOST:
                found = [a + b for a, b in zip(found, fine, strict=True)]
            else:
                halved += parts
        open_ = halved
    return found
