"""Uniform lattices on SO(3): vertices of the five centrally symmetric regular 4-polytopes, halved [MMB2017].

Of each antipodal pair, which is one orientation, the vertex whose first non-zero coordinate is
positive is kept. Order: the 24-cell as the paper numbers it; the others by descending coordinates
(w, then x, y, z), so that the identity, where it is a vertex, comes first. The 120-cell is the one
dual to the 600-cell given here; the identity is not among its vertices.
"""

from collections.abc import Callable, Iterable, Iterator
from itertools import permutations, product
from math import sqrt

import numpy as np

from timelaw.numerics.array import Array

Vertex = tuple[float, ...]

PHI = (1 + sqrt(5)) / 2


def make_lattice(name: str) -> Array:
    """Unit quaternions (N, 4) of a halved polytope: N = 4, 8, 12, 60, 300."""
    return LATTICES[name]()


def sixteen_cell() -> Array:
    """Four orientations: the identity and half-turns about the three body axes."""
    return np.eye(4)


def tesseract() -> Array:
    """Eight orientations (½, ±½, ±½, ±½)."""
    return _halved(_signed((0.5, 0.5, 0.5, 0.5)))


def twenty_four_cell() -> Array:
    """Twelve orientations in the numbering of [MMB2017]: the 16-cell's, then the tesseract's."""
    signs = [
        (1, 1, 1),
        (-1, 1, 1),
        (1, -1, 1),
        (1, 1, -1),
        (-1, -1, 1),
        (1, -1, -1),
        (-1, 1, -1),
        (-1, -1, -1),
    ]
    return np.concatenate([np.eye(4), [(0.5, 0.5 * x, 0.5 * y, 0.5 * z) for x, y, z in signs]])


def six_hundred_cell() -> Array:
    """Sixty orientations: the 24-cell's and the even permutations of (±φ, ±1, ±1/φ, 0)/2."""
    vertices = [tuple(v) for v in twenty_four_cell()]
    for base in _signed((PHI / 2, 0.5, 1 / (2 * PHI), 0.0)):
        vertices += _permuted(base, even=True)
    return _halved(vertices)


def hundred_twenty_cell() -> Array:
    """Three hundred orientations: the seven classes of vertices of norm √8, scaled to one."""
    p1, p2, root = PHI, PHI**2, sqrt(5)
    every = [(2, 2, 0, 0), (root, 1, 1, 1), (p1, p1, p1, 1 / p2), (p2, 1 / p1, 1 / p1, 1 / p1)]
    even = [(p2, 1 / p2, 1, 0), (root, 1 / p1, p1, 0), (2, 1, p1, 1 / p1)]
    vertices: list[Vertex] = []
    for bases, only_even in ((every, False), (even, True)):
        for base in bases:
            for signed in _signed(base):
                vertices += _permuted(signed, even=only_even)
    return _halved([tuple(c / sqrt(8) for c in v) for v in vertices])


LATTICES: dict[str, Callable[[], Array]] = {
    "16-cell": sixteen_cell,
    "tesseract": tesseract,
    "24-cell": twenty_four_cell,
    "600-cell": six_hundred_cell,
    "120-cell": hundred_twenty_cell,
}


def _signed(base: Vertex) -> Iterator[Vertex]:
    """All choices of sign of the non-zero coordinates."""
    return (v for v in product(*[(c, -c) if c else (c,) for c in base]))


def _permuted(base: Vertex, *, even: bool) -> Iterator[Vertex]:
    """All permutations of four coordinates, or the even ones."""
    for order in permutations(range(4)):
        inversions = sum(order[i] > order[j] for i in range(4) for j in range(i))
        if not even or inversions % 2 == 0:
            yield tuple(base[i] for i in order)


def _halved(vertices: Iterable[Vertex]) -> Array:
    """One of each antipodal pair, each once, in descending order of coordinates."""
    kept: dict[Vertex, Vertex] = {}
    for v in vertices:
        key = tuple(round(c, 9) + 0.0 for c in v)  # vertices are 0.1 and more apart
        if key > (0.0, 0.0, 0.0, 0.0):
            kept[key] = v
    return np.array([kept[key] for key in sorted(kept, reverse=True)])
