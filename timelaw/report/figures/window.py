"""Which legs are drawn in full: all of a short motion, of a long one where the limits bind most."""

from collections.abc import Sequence

import numpy as np

from timelaw.certificate import Certificate
from timelaw.motion import QuaternionLaw, Segment

FULL = 14  # legs that are drawn in full; of longer motions a part is
PART = 8  # legs of that part


def is_long(law: QuaternionLaw) -> bool:
    """Whether only a part of it can be drawn in full."""
    return len(law.legs) > FULL


def choose_window(law: QuaternionLaw, certificate: Certificate) -> tuple[Segment, ...]:
    """The segments drawn in full: where most proved peaks lie, then where most of the limits is used."""
    if not is_long(law):
        return law.segments
    legs = [index for index, segment in enumerate(law.segments) if segment.moves]
    weight = np.zeros(len(law.segments))
    for peak in certificate.peaks:
        weight[peak.index] = max(weight[peak.index], min(peak.used, 1.0))
    for check in certificate.limits:
        found = np.searchsorted(law.times, check.time, side="right") - 1
        weight[min(max(int(found), 0), len(weight) - 1)] += 1.0
    sums = np.convolve(weight[legs], np.ones(PART), mode="valid")
    first = int(np.argmax(np.round(sums, 9)))
    return law.segments[legs[first] : legs[first + PART - 1] + 1]


def name_window(law: QuaternionLaw, window: Sequence[Segment]) -> str:
    """What it is called; empty where it is all."""
    if len(window) == len(law.segments):
        return ""
    legs = [segment for segment in law.segments if segment.moves]
    first = next(i for i, leg in enumerate(legs) if leg is window[0])
    return f"legs {first + 1} to {first + PART} of {len(legs)}"


def cut_alike(law: QuaternionLaw, part: Sequence[Segment], other: QuaternionLaw) -> tuple[Segment, ...]:
    """The same legs of another law over the same route; all of it where they are not known by number."""
    if len(part) == len(law.segments) or len(other.legs) != len(law.legs):
        return other.segments
    numbers = [i for i, leg in enumerate(law.legs) if any(leg is s for s in part)]
    first, last = other.legs[numbers[0]], other.legs[numbers[-1]]
    start = next(i for i, s in enumerate(other.segments) if s is first)
    end = next(i for i, s in enumerate(other.segments) if s is last)
    return other.segments[start : end + 1]
