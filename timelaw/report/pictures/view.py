"""How a picture looks at the world: parallel projection, what is near and what is far, a box's faces."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from timelaw.numerics.array import Array

DEFAULT_SHAPE = (1.0, 0.66, 0.4)  # edges of the box where the law has none: no two alike
EXTENT = 0.56  # half the box's diagonal, of the sphere's radius
RING = np.linspace(0.0, 2 * np.pi, 73)
CORNERS = np.array(list(product((-1.0, 1.0), repeat=2)))[[0, 1, 3, 2]]  # of a face, going round


@dataclass(frozen=True)
class View:
    """From where it looks: angles [deg] about the world's z axis and above its plane."""

    azimuth: float = 35.0
    elevation: float = 22.0

    @property
    def frame(self) -> Array:
        """Rows: the directions to the right, up, and towards who looks (3, 3)."""
        a, e = np.radians([self.azimuth, self.elevation])
        return np.array(
            [
                [-np.sin(a), np.cos(a), 0.0],
                [-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)],
                [np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)],
            ]
        )

    def project(self, points: Array) -> Array:
        """Points (..., 3) as right, up, and how near (..., 3)."""
        return np.asarray(points @ self.frame.T)


@dataclass(frozen=True)
class Face:
    """A side of a box that is seen: axis, sense, corners (4, 3) in the world; `facing` is 1 if square on."""

    axis: int
    sense: float
    corners: Array
    facing: float


def list_faces(rotation: Array, half: Array, view: View) -> list[Face]:
    """The sides that are seen of a box about the origin with half edges (3,), turned by R (3, 3)."""
    near = view.frame[2]
    found = []
    for axis in range(3):
        for sense in (-1.0, 1.0):
            facing = sense * float(rotation[:, axis] @ near)
            if facing > 0:
                u, v = (axis + 1) % 3, (axis + 2) % 3
                local = np.zeros((4, 3))
                local[:, axis] = sense * half[axis]
                local[:, [u, v]] = CORNERS * half[[u, v]]
                found.append(Face(axis, sense, local @ rotation.T, facing))
    return found


def size_box(shape: tuple[float, float, float] | None) -> Array:
    """Half edges (3,) of a law's shape, its half diagonal the part of the sphere's radius that boxes have."""
    edges = np.array(DEFAULT_SHAPE if shape is None else shape)
    return np.asarray(EXTENT * edges / np.linalg.norm(edges))


def list_circles() -> list[Array]:
    """Meridians and parallels of the unit sphere, each (73, 3)."""
    c, s = np.cos(RING), np.sin(RING)
    found = [[c * np.cos(a), c * np.sin(a), s] for a in np.radians(np.arange(0, 180, 30))]
    levels = np.radians([-60, -30, 0, 30, 60])
    found += [[np.cos(b) * c, np.cos(b) * s, np.full(len(RING), np.sin(b))] for b in levels]
    return [np.array(circle).T for circle in found]


def split_sides(projected: Array) -> tuple[Array, Array]:
    """A path (m, 3) as its near and its far parts (m, 2), not numbers where it is on the other side.

    The far parts reach one point into the near ones, so that nothing is left out between them.
    """
    near = projected[:, 2] >= 0
    far = ~near
    far[1:] |= ~near[:-1]
    far[:-1] |= ~near[1:]
    sides = (np.where(part[:, None], projected[:, :2], np.nan) for part in (near, far))
    front, back = sides
    return front, back
