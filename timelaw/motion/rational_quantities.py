"""What limits bound on rational segments: every limit's own formula, on parts of pieces where D is even."""

from collections import defaultdict
from collections.abc import Sequence
from itertools import chain, pairwise
from typing import TYPE_CHECKING

import numpy as np

from timelaw.limits import Limit
from timelaw.limits.formula import Vector
from timelaw.limits.registry import list_formula_rows
from timelaw.motion.origin_curve import derive_origins
from timelaw.motion.quaternion_curve import stack_curves
from timelaw.motion.segment import Quantity

if TYPE_CHECKING:
    from timelaw.motion.rational import Rational


def list_quantities(
    segments: "Sequence[Rational]", limits: Sequence[Sequence[Limit]], total: Vector
) -> list[list[Quantity]]:
    """Of each segment; `total` is H (3,) in the world. Limits that differ in bounds alone are taken together.

    They have the same numerators.
    """
    alike: dict[tuple[tuple[str, int], ...], list[int]] = defaultdict(list)
    for k, own in enumerate(limits):
        alike[tuple((limit.name, np.ndim(limit.bounds)) for limit in own)].append(k)
    found: list[list[Quantity]] = [[] for _ in segments]
    for forms, numbers in alike.items():
        if forms:
            bounded = _bound([segments[k] for k in numbers], [limits[k] for k in numbers], total)
            for k, quantities in zip(numbers, bounded, strict=True):
                found[k] = quantities
    return found


def number_pieces(segments: "Sequence[Rational]") -> list[slice]:
    """Where the pieces of each segment are among those of all."""
    bounds = np.cumsum([0, *(len(s.pieces) for s in segments)]).tolist()
    return [slice(first, last) for first, last in pairwise(bounds)]


def _bound(
    segments: "Sequence[Rational]", limits: Sequence[Sequence[Limit]], total: Vector
) -> list[list[Quantity]]:
    """Quantities of segments whose limits differ in their bounds alone."""
    pieces = [piece for s in segments for piece in s.pieces]
    origins = [origin for s in segments for origin in s.origins]  # of all pieces, or of none
    times = [pair for s in segments for pair in pairwise(s.breaks.tolist())]
    rows = [own for s, own in zip(segments, map(list_formula_rows, limits), strict=True) for _ in s.pieces]
    found: list[list[Quantity]] = [[] for _ in pieces]
    for stack in stack_curves(pieces):
        form = stack.form.split()
        places = [origins[k] for k in stack.piece] if len(origins) == len(pieces) else []
        moved = derive_origins(places, form) if places else {}
        values = form.divide_formulas(limits[0], total, moved)
        parts = zip(stack.piece[form.piece].tolist(), form.start.tolist(), form.end.tolist(), strict=True)
        for (k, *ends), own in zip(parts, zip(*values, strict=True), strict=True):
            first, last = times[k]
            start, end = (first + (last - first) * u for u in ends)
            found[k] += [Quantity(row, value, start, end) for row, value in zip(rows[k], own, strict=True)]
    return [list(chain.from_iterable(found[own])) for own in number_pieces(segments)]
