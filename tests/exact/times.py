"""Times: segments that follow each other, clocks that resolve them, pieces that fill them; and the body."""

from itertools import pairwise
from math import ulp

from flint import fmpq, fmpq_poly

from tests.exact.motion import Motion
from tests.exact.rational import CLEAR, read, show, surely_exceeds

ULPS = 2  # between a start time and the end of the segment before
RESOLVED = 1e6  # spacings of doubles in a segment
FILLED = 1e-12  # of a segment's duration, and of the file's
SYMMETRIC = 1e-9  # of the largest entry of the inertia
POSSIBLE = 1e-9  # of the sum of the two other principal moments


def find_wrong_times(motion: Motion) -> list[str]:
    """P4: instants that do not add up, and segments that no clock resolves."""
    found = []
    if motion.segments[0].begins != 0:
        found.append(f"P4 the motion starts at {show(motion.segments[0].begins)}")
    for a, b in pairwise(motion.segments):
        end = a.begins + a.duration
        spacing = max(_spacing(end), _spacing(b.begins))
        if surely_exceeds(abs(b.begins - end) / spacing, ULPS):
            found.append(f"P4 {b.place} starts {show(b.begins - end)} s after the end of {a.place}")
    return found + _find_unresolved(motion) + _find_unfilled(motion)


def _spacing(time: fmpq) -> fmpq:
    return read(ulp(abs(int(time.p)) / int(time.q)))  # Python rounds the quotient of integers once


def _find_unresolved(motion: Motion) -> list[str]:
    found = []
    for segment in motion.segments:
        resolution = segment.duration / _spacing(segment.begins + segment.duration)
        if resolution < read(RESOLVED * (1 - CLEAR)):
            found.append(f"P4 {segment.place} lasts {show(resolution)} spacings of its clock")
    return found


def _find_unfilled(motion: Motion) -> list[str]:
    found = []
    for segment in motion.moving:
        filled = sum((piece.duration for piece in segment.pieces), fmpq(0))
        error = abs(filled / segment.duration - 1)
        if surely_exceeds(error, FILLED):
            found.append(f"P4 pieces of {segment.place} are off its duration by {show(error)} of it")
    given = motion.document.get("duration")
    if given is None or surely_exceeds(abs(read(given) / motion.end - 1), FILLED):
        found.append(f"P4 the file gives a duration of {given}, it is {show(motion.end)}")
    return found


def find_impossible_body(motion: Motion) -> list[str]:
    """P7: an inertia that no rigid body has."""
    if motion.inertia is None:
        return []
    matrix = motion.inertia
    size = max(abs(x) for row in matrix for x in row)
    skew = max(abs(matrix[i][j] - matrix[j][i]) for i in range(3) for j in range(3))
    if size == 0 or surely_exceeds(skew / size, SYMMETRIC):
        return ["P7 the inertia is not symmetric" if size else "P7 the inertia is zero"]
    moments = find_principal_moments(matrix)
    if moments[0] < 0 or moments[0].is_zero():
        return [f"P7 a principal moment is {show(moments[0])}"]
    excess = moments[2] / (moments[0] + moments[1]) - 1
    if surely_exceeds(excess, POSSIBLE):
        return [f"P7 a principal moment exceeds the sum of the others by {show(excess)}"]
    return []


def find_principal_moments(matrix: list[list[fmpq]]) -> list:
    """The eigenvalues of the symmetric part, balls in ascending order."""
    (a, d, e), (_, b, f), (_, _, c) = [
        [(matrix[i][j] + matrix[j][i]) / 2 for j in range(3)] for i in range(3)
    ]
    determinant = a * b * c + 2 * d * e * f - a * f * f - b * e * e - c * d * d
    minors = a * b + a * c + b * c - d * d - e * e - f * f
    p = fmpq_poly([-determinant, minors, -(a + b + c), 1])
    moments = [place.real for place, times in p.complex_roots() for _ in range(times)]
    return sorted(moments, key=lambda ball: ball.mid())
