"""Isometries of a lattice that is a group: they carry tours to tours with the same legs and turns."""

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import conjugate, multiply
from timelaw.tours.ends import Ends

Order = tuple[int, ...]

CLOSE = 1e-9  # of |q·q| from one, where two vertices are the same
AMPLIFIED = 20.0  # times what four nearest neighbours are off, all others are off when carried by them


def find_permutation(quaternions: Array, images: Array, close: float = CLOSE) -> list[int] | None:
    """Which node each image (N, 4) is, up to sign, with |q·q| within `close` of 1; None if some is none."""
    cosines = np.abs(images @ quaternions.T)
    nodes = [int(node) for node in np.argmax(cosines, axis=1)]
    if np.min(np.max(cosines, axis=1)) < 1 - close or len(set(nodes)) < len(nodes):
        return None
    return nodes


def find_congruence(model: Array, points: Array, precision: float = 0.0) -> list[int] | None:
    """Which node of `points` each vertex of `model` is, up to sign, after an isometry between the two sets.

    A tetrahedron of nearest neighbours is carried to another one; where all of them are alike, as
    in the 600-cell, that finds the isometry if there is one. None if it does not. The points may be
    `precision` [rad of body turn] away from where they belong.
    """
    if len(model) != len(points):
        return None
    close = max(CLOSE, AMPLIFIED * precision)
    frames = [_tetrahedron(model, CLOSE), _tetrahedron(points, close)]
    if any(len(frame) < 4 for frame in frames):
        return None
    carried = model @ np.linalg.solve(*frames)
    if not np.allclose(carried @ carried.T, model @ model.T, atol=max(1e-8, close)):
        return None
    return find_permutation(points, carried, close)


def _tetrahedron(quaternions: Array, close: float) -> Array:
    """Vertices (4, 4), signed, of nearest neighbours around the first; fewer rows if there are none."""
    nearest = np.sort(np.abs(quaternions[0] @ quaternions.T))[-2]
    chosen = quaternions[:1]
    for vertex in (s * q for q in quaternions[1:] for s in (1.0, -1.0)):
        if len(chosen) < 4 and np.all(np.abs(chosen @ vertex - nearest) < close):
            chosen = np.vstack([chosen, vertex])
    return chosen


def move_tour(order: Order, quaternions: Array, ends: Ends) -> Order | None:
    """The tour carried, and turned round where needed, to begin and end where it should.

    x ↦ l ⊗ x ⊗ r with l, r from the set maps distances and great circles onto themselves; None if
    no such map of the set onto itself does it.
    """
    for candidate in (order, order[::-1]):
        first, last = quaternions[candidate[0]], quaternions[candidate[-1]]
        start = candidate[0] if ends.start is None else ends.start
        for right in quaternions:
            if ends.start is None and ends.end is not None:
                left = multiply(quaternions[ends.end], conjugate(multiply(last, right)))
            else:
                left = multiply(quaternions[start], conjugate(multiply(first, right)))
            nodes = find_permutation(quaternions, multiply(multiply(left, quaternions), right))
            if nodes is None:
                return None
            found = tuple(nodes[node] for node in candidate)
            if ends.admits(found):
                return found
            if ends.start is None or ends.end is None:
                break  # with one end given every map does or none
    return None


def find_stabiliser(quaternions: Array, node: int, neighbour: int) -> list[list[int]]:
    """Maps x ↦ l ⊗ x ⊗ r and x ↦ l ⊗ x* ⊗ r, as permutations, that leave two nodes where they are.

    With l and r from the set: all such maps if it is a group, otherwise some, the identity always.
    """
    found = [list(range(len(quaternions)))]
    for images in (quaternions, conjugate(quaternions)):
        for right in quaternions:
            left = multiply(quaternions[node], conjugate(multiply(images[node], right)))
            nodes = find_permutation(quaternions, multiply(multiply(left, images), right))
            if nodes is not None and nodes[neighbour] == neighbour:
                found.append(nodes)
    return found
