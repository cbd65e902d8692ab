"""Which limits are active where: the part of each that a segment uses, proved, and its course in time."""

from collections import defaultdict
from collections.abc import Sequence

import numpy as np

from timelaw.certificate import Certificate
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.report.figures.curves import place_points

ACTIVE = 0.999  # of a limit; solvers leave a millionth, what is used to this part is what bounds the law


def list_active(certificate: Certificate) -> dict[int, list[str]]:
    """By the index of a segment the limits that it uses up."""
    found: dict[int, list[str]] = defaultdict(list)
    for peak in certificate.peaks:
        if peak.used >= ACTIVE:
            found[peak.index].append(peak.label)
    return found


def trace_parts(
    law: QuaternionLaw, segments: Sequence[Segment], limit: str
) -> dict[str, tuple[Array, Array]]:
    """By label the times [s] and the part of a limit, say the torque, that is used at them."""
    curves: dict[str, tuple[list[Array], list[Array]]] = {}
    for segment, labelled in zip(segments, law.list_quantities(segments), strict=True):
        for label, quantity in labelled:
            row, value = quantity.row, quantity.value
            if row.limit != limit or label != row.label:
                continue  # another limit, or one of that segment alone
            start, end = segment.start_time + segment.duration * np.array([quantity.start, quantity.end])
            u = place_points(value.degree)
            times, values = curves.setdefault(row.label, ([], []))
            times.append(start + u * (end - start))
            values.append((np.abs(value(u)) / row.bound) ** (1 / row.root))
    return {label: (np.concatenate(t), np.concatenate(v)) for label, (t, v) in curves.items()}
