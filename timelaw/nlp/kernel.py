"""What is asked at one point of a leg, as a CasADi function of few variables and of parameters.

At a point τ the k-th rate of the angle is t^-k (e + b·x + Σ l_i v_i t^i + Σ r_i w_i t^i): t is the leg's
duration in units of the start's, x are the free coefficients that reach there, v and w the rates at the
leg's two ends, and e, b, l, r numbers, the parameters. A row or an effort is a polynomial in the rates, of
which the coefficients are parameters too. So one kernel serves all legs, however they differ, and its
derivatives are made once.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import casadi as ca

from timelaw.nlp.monomials import Exponents

KEPT = 1024  # functions; one takes some ten kilobytes


class End(NamedTuple):
    """How many rates at an end of the leg enter, and whether they are variables or given."""

    rates: int = 0
    shared: bool = False

    @property
    def variables(self) -> int:
        """How many are for the solver to choose."""
        return self.rates if self.shared else 0


@dataclass(frozen=True)
class Kernel:
    """g = t^lasting Σ c Π φ^(k)^e - u^root, u the used part of the limits, in it only with a `root`.

    Variables z: t, x (`free`), v, w, u, those that are there. Parameters p: e, b, l, r of each of the
    `orders`, then the coefficients c.
    """

    orders: tuple[int, ...]
    exponents: tuple[Exponents, ...]
    free: int
    left: End
    right: End
    lasting: int = 0
    root: int = 0

    @property
    def variables(self) -> int:
        """How many enter."""
        return 1 + self.free + self.left.variables + self.right.variables + bool(self.root)

    @property
    def parameters(self) -> int:
        """How many enter."""
        each = 1 + self.free + self.left.rates + self.right.rates
        return len(self.orders) * each + len(self.exponents)

    def expression(self, z: Any, p: Any) -> Any:
        """G of symbols or numbers z and p."""
        t, place = z[0], 1 + self.free
        ends = []
        for end in (self.left, self.right):
            symbols = [z[place + i] if end.shared else 1.0 for i in range(end.rates)]
            ends += [symbol * t**i for i, symbol in enumerate(symbols, 1)]
            place += end.variables
        factors = [1.0, *(z[1 + i] for i in range(self.free)), *ends]
        rates, width = [], len(factors)
        for k, order in enumerate(self.orders):
            weights = [p[k * width + i] for i in range(width)]
            rates.append(sum(w * f for w, f in zip(weights, factors, strict=True)) / t**order)
        terms = [p[len(self.orders) * width + m] for m in range(len(self.exponents))]
        for m, exponents in enumerate(self.exponents):
            for rate, exponent in zip(rates, exponents, strict=True):
                terms[m] *= rate**exponent
        value = sum(terms[1:], terms[0]) * t**self.lasting
        return value - z[place] ** self.root if self.root else value


class Derivatives(NamedTuple):
    """Functions of (z, p) and, the last, of (z, p, λ).

    They give the `entries` of the gradient, and λ times those of the Hessian at (i, j) in `pairs`, i ≤ j.
    """

    value: Any
    gradient: Any
    hessian: Any
    entries: Sequence[int]
    pairs: Sequence[tuple[int, int]]


@lru_cache(maxsize=KEPT)
def differentiate_kernel(kernel: Kernel) -> Derivatives:
    """The kernel with its derivatives, as functions."""
    z, p, multiplier = (
        ca.SX.sym(name, size) for name, size in (("z", kernel.variables), ("p", kernel.parameters), ("m", 1))
    )
    value = kernel.expression(z, p)
    hessian, slope = ca.hessian(value, z)
    slope, upper = ca.sparsify(slope), ca.triu(hessian)
    entries = slope.sparsity().row()
    rows, columns = upper.sparsity().get_triplet()
    return Derivatives(
        ca.Function("value", [z, p], [value]),
        ca.Function("gradient", [z, p], [_list_entries(slope)]),
        ca.Function("hessian", [z, p, multiplier], [multiplier * _list_entries(upper)]),
        entries,
        list(zip(rows, columns, strict=True)),
    )


def _list_entries(matrix: Any) -> Any:
    """A sparse matrix's own entries as a column."""
    return ca.vertcat(ca.SX(0, 1), *map(ca.SX, matrix.nonzeros()))


@lru_cache(maxsize=KEPT)
def repeat_kernel(kernel: Kernel, points: int) -> Derivatives:
    """The same at so many points that share their variables: the Hessians of all points are added."""
    value, gradient, hessian, entries, pairs = differentiate_kernel(kernel)
    z, p = ca.SX.sym("z", kernel.variables), ca.SX.sym("p", kernel.parameters, points)
    multipliers = ca.SX.sym("m", 1, points)
    each = value.map("each", "serial", points, [0], [])(z, p)
    slopes = gradient.map("each", "serial", points, [0], [])(z, p)
    curve = hessian.map("each", "serial", points, [0], [0])(z, p, multipliers)
    return Derivatives(
        ca.Function("values", [z, p], [each]),
        ca.Function("gradients", [z, p], [slopes]),
        ca.Function("hessians", [z, p, multipliers], [curve]),
        entries,
        pairs,
    )
