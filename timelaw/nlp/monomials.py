"""Rows and efforts as lists of monomials in the rates: what differs between legs are but coefficients."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

Exponents = tuple[int, ...]  # of the rates of a row, in the order of its orders


@dataclass(frozen=True)
class Monomials:
    """A polynomial in the rates: the coefficient of each product of powers; knows + and ×."""

    terms: Mapping[Exponents, float]

    def __add__(self, other: "Monomials") -> "Monomials":
        terms = dict(self.terms)
        for exponents, coefficient in other.terms.items():
            terms[exponents] = terms.get(exponents, 0.0) + coefficient
        return Monomials(terms)

    def __mul__(self, other: "Monomials | float") -> "Monomials":
        if not isinstance(other, Monomials):
            return Monomials({exponents: c * float(other) for exponents, c in self.terms.items()})
        total = Monomials({})
        for exponents, c in other.terms.items():
            product = {
                tuple(a + b for a, b in zip(own, exponents, strict=True)): d * c
                for own, d in self.terms.items()
            }
            total = total + Monomials(product)
        return total

    __rmul__ = __mul__


def expand_monomials(
    value: Callable[[Mapping[int, Any]], Any], orders: Sequence[int]
) -> tuple[tuple[Exponents, ...], tuple[float, ...]]:
    """Exponents and coefficients of a polynomial in the rates of these orders."""
    rates = {
        order: Monomials({tuple(int(k == place) for k in range(len(orders))): 1.0})
        for place, order in enumerate(orders)
    }
    terms = value(rates).terms
    return tuple(terms), tuple(terms.values())
