"""The whole motion as one algebraic expression, for any durations, arcs, easings and dwells [MMB2017].

λ(t) = Σ_k H_k(t) {…}, H_ab(t) = ½[1 + (t-a)/√((t-a)²) · (b-t)/√((b-t)²)], which is 1 inside (a, b) and 0
outside. At the nodes, and where the pieces of an easing meet, it is 0/0.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from timelaw.export.segment_tables import TABLES
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate
from timelaw.numerics.quaternion import normalise


@dataclass(frozen=True)
class Span:
    """A polynomial on (a, b) [s]: Σ c_i C(n, i) u^i (1 - u)^(n - i), u = (t - a)/(b - a), c (n+1, w)."""

    a: float
    b: float
    control: Array

    def __call__(self, t: Array) -> Array:
        """The polynomial (m, w); u stays in [0, 1], beyond which H is zero."""
        u = np.clip((t - self.a) / (self.b - self.a), 0.0, 1.0)
        return np.asarray(evaluate(self.control.T[:, None], u)).T


@dataclass(frozen=True)
class Term:
    """What holds from a to b [s]: λ_k (4,) to λ_(k+1) (4,) over an arc ϑ, a quaternion polynomial, or rest.

    `spans` are those of the easing f_k, the one of the polynomial Q_k, or none.
    """

    a: float
    b: float
    start: Array
    end: Array
    spans: tuple[Span, ...]
    arc: float | None = None

    def __call__(self, t: Array) -> Array:
        """The term (m, 4) of the sum, its own H included."""
        step = evaluate_step(t, self.a, self.b)[:, None]
        if not self.spans:
            return np.asarray(step * self.start)
        value = self.spans[0](t)
        if len(self.spans) > 1:
            value = np.asarray(sum(evaluate_step(t, s.a, s.b)[:, None] * s(t) for s in self.spans))
        if self.arc is None:
            return np.asarray(step * value / np.linalg.norm(value, axis=1, keepdims=True))
        before, after = np.sin(self.arc * (1 - value)), np.sin(self.arc * value)
        return np.asarray(step * (self.start * before + self.end * after) / np.sin(self.arc))


def evaluate_step(t: Array, a: float, b: float) -> Array:
    """H_ab(t) (m,) as it is written: 1 inside (a, b), 0 outside, not a number at a and b."""
    with np.errstate(invalid="ignore"):
        up, down = (t - a) / np.sqrt((t - a) ** 2), (b - t) / np.sqrt((b - t) ** 2)
    return np.asarray((1 + up * down) / 2)


def list_terms(law: QuaternionLaw) -> list[Term]:
    """The terms of the sum: one a segment, one a piece of those that are no arcs."""
    times = pairwise(law.times.tolist())
    segments = zip(law.segments, times, strict=True)
    return [term for segment, (a, b) in segments for term in TERMS[segment.kind](a, b, segment.document())]


def evaluate_formula(law: QuaternionLaw, t: ArrayLike) -> Array:
    """λ(t) (..., 4) by the one expression; not a number where it is 0/0."""
    t = np.asarray(t, dtype=float)
    value = np.asarray(sum(term(t.ravel()) for term in list_terms(law)))
    return value.reshape(*t.shape, 4)


def _spans(a: float, b: float, kind: str, document: Mapping[str, Any]) -> list[Span]:
    """The first functions of a segment's pieces, over the times in which they follow each other."""
    pieces = TABLES[kind](document).pieces
    lengths = np.array([piece.length for piece in pieces])
    ends = (a + (b - a) * np.concatenate([[0.0], np.cumsum(lengths) / np.sum(lengths)])).tolist()
    ends[-1] = b
    return [
        Span(first, last, piece.functions[0])
        for (first, last), piece in zip(pairwise(ends), pieces, strict=True)
    ]


def _arc(a: float, b: float, document: Mapping[str, Any]) -> list[Term]:
    angle = document["angle"]
    spans = tuple(Span(s.a, s.b, s.control / angle) for s in _spans(a, b, "arc", document))
    return [Term(a, b, normalise(document["start"]), normalise(document["end"]), spans, angle / 2)]


def _dwell(a: float, b: float, document: Mapping[str, Any]) -> list[Term]:
    rest = normalise(document["orientation"])
    return [Term(a, b, rest, rest, ())]


def _rational(a: float, b: float, document: Mapping[str, Any]) -> list[Term]:
    spans = _spans(a, b, "rational", document)
    return [Term(s.a, s.b, normalise(s.control[0]), normalise(s.control[-1]), (s,)) for s in spans]


TERMS: dict[str, Callable[[float, float, Mapping[str, Any]], list[Term]]] = {
    "arc": _arc,
    "dwell": _dwell,
    "rational": _rational,
}
