"""Which limits bind where: the part of each limit that a segment uses, proved, and its course in time."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from timelaw.limits.polynomials import row_polynomials
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate
from timelaw.numerics.extrema import peaks
from timelaw.report.curves import POINTS_PER_DEGREE

BINDS = 0.999  # of a limit; solvers leave a millionth, what is used to this part is what bounds the law


def used_parts(law: QuaternionLaw, segment: Segment) -> dict[str, float]:
    """For each limit the largest part of it that a segment uses."""
    found = [entry for row, _ in law.rows(segment) for entry in row_polynomials([row], segment.rates)]
    parts: dict[str, float] = {}
    for (row, _, polynomial), top in zip(found, peaks([p.control for _, _, p in found]), strict=True):
        part = ((top.upper + polynomial.error) / row.bound) ** (1 / row.root)
        parts[row.label] = max(parts.get(row.label, 0.0), part)
    return parts


def binding(law: QuaternionLaw, segment: Segment) -> list[str]:
    """The limits that a segment uses up."""
    return [label for label, part in used_parts(law, segment).items() if part >= BINDS]


def part_curves(
    law: QuaternionLaw, segments: Sequence[Segment], limit: str
) -> dict[str, tuple[Array, Array]]:
    """By label the times [s] and the part of a limit, say the torque, that is used at them."""
    curves: dict[str, tuple[list[Array], list[Array]]] = {}
    for segment in segments:
        breaks = list(pairwise(segment.start_time + segment.duration * segment.breaks))
        rows = [row for row, own in law.rows(segment) if row.limit == limit and not own]
        for row, piece, polynomial in row_polynomials(rows, segment.rates):
            start, end = breaks[piece]
            u = np.linspace(0.0, 1.0, 3 + POINTS_PER_DEGREE * polynomial.degree)
            times, values = curves.setdefault(row.label, ([], []))
            times.append(start + u * (end - start))
            values.append((np.abs(evaluate(polynomial.control, u)) / row.bound) ** (1 / row.root))
    return {label: (np.concatenate(t), np.concatenate(v)) for label, (t, v) in curves.items()}
