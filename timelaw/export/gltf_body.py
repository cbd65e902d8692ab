"""The body as glTF shows it: a box, and bars along its axes, as triangles."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from timelaw.numerics.array import Array

EDGES = (1.0, 0.75, 0.5)  # m; of a body whose shape is not given: no two alike, so that one sees how it turns
BOX = (0.75, 0.78, 0.82)
AXES = (("x", (0.85, 0.1, 0.1)), ("y", (0.1, 0.65, 0.15)), ("z", (0.1, 0.25, 0.9)))
REACH, THICKNESS = 0.5, 0.04  # of the longest edge: beyond the box, and across


@dataclass(frozen=True)
class MeshPart:
    """Triangles of one colour: `positions` and `normals` (24, 3), `indices` (36,)."""

    name: str
    colour: tuple[float, float, float]
    positions: Array
    normals: Array
    indices: Array


def list_parts(shape: tuple[float, float, float] | None) -> Iterator[MeshPart]:
    """A box with the edges `shape` [m] about the origin, and its three axes."""
    edges = np.array(shape or EDGES)
    yield _make_box("box", BOX, -edges / 2, edges / 2)
    longest = float(np.max(edges))
    for index, (name, colour) in enumerate(AXES):
        low, high = np.full(3, -THICKNESS * longest / 2), np.full(3, THICKNESS * longest / 2)
        high[index] = edges[index] / 2 + REACH * longest
        yield _make_box(name, colour, low, high)


def _make_box(name: str, colour: tuple[float, float, float], low: Array, high: Array) -> MeshPart:
    """Six faces of two triangles, counterclockwise from outside."""
    positions: list[Array] = []
    normals: list[Array] = []
    indices: list[int] = []
    for axis in range(3):
        for sense in (-1.0, 1.0):
            normal = np.eye(3)[axis] * sense
            first, second = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            if sense < 0:
                first, second = second, first  # so that first × second points outwards
            corners = [normal + a * first + b * second for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            start = len(positions)
            positions += [(low + high) / 2 + corner * (high - low) / 2 for corner in corners]
            normals += [normal] * 4
            indices += [start, start + 1, start + 2, start, start + 2, start + 3]
    return MeshPart(name, colour, np.array(positions), np.array(normals), np.array(indices))
