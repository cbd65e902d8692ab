"""Which orientations of a set are the same: up to sign, and up to the rotations of a crystal class."""

from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import multiply

# Rotation groups of the crystal classes, by the names of SciPy's groups (Schoenflies); a class and its
# Laue class turn alike. The main axis is the body's z.
CRYSTALS = {
    "1": "C1", "-1": "C1", "2": "C2", "2/m": "C2", "222": "D2", "mmm": "D2",
    "4": "C4", "4/m": "C4", "422": "D4", "4/mmm": "D4", "3": "C3", "-3": "C3", "32": "D3", "-3m": "D3",
    "6": "C6", "6/m": "C6", "622": "D6", "6/mmm": "D6", "23": "T", "m-3": "T", "432": "O", "m-3m": "O",
}  # fmt: skip
CONJUGATE = np.array([1.0, -1.0, -1.0, -1.0])  # (q ⊗ s)_w = q · s*
ROUNDING = 1e-12  # of products of unit quaternions; what is looked at needlessly only costs time
BLOCK = 4096  # orientations that are looked at together
FEW = 64  # orientations for which comparing all with all is quicker than a tree

Indices = NDArray[np.intp]
GROUPS = ("I", "O", "T", *(f"{kind}{order}" for kind in "CD" for order in range(1, 13)))


def make_rotation_group(name: str) -> Array:
    """Unit quaternions (K, 4) of a rotation group: a crystal class such as m-3m or 622, or I, O, T, Cn, Dn.

    Raises:
        InputError: no such group.
    """
    from scipy.spatial.transform import Rotation

    group = CRYSTALS.get(name, name)
    if group not in GROUPS:
        close = get_close_matches(name, [*CRYSTALS, *GROUPS], n=1)
        hint = f'; did you mean "{close[0]}"?' if close else ""
        listing = ", ".join(CRYSTALS)
        message = f'"{name}"; allowed: {listing}, or I, O, T, C1 to C12, D1 to D12{hint}'
        raise InputError(Fault(message, "route.orientations.symmetry"))
    return np.asarray(Rotation.create_group(cast(Any, group)).as_quat(scalar_first=True))


def find_equivalents(quaternions: Array, tolerance: float, group: Array | None = None) -> list[int]:
    """For each orientation of (N, 4) the first of those kept that it is the same as, itself if none is.

    q_i and q_j are the same if some s of the group turns q_j ⊗ s to within `tolerance` [rad] of ±q_i. An
    orientation is kept if it is the same as none kept before it. Time grows as N log² N and memory as N,
    however close together they are: those kept are apart, and only they are looked for.
    """
    first = np.arange(len(quaternions))
    turns = np.eye(4)[:1] if group is None else group
    reduced = np.concatenate([np.empty((0, 4)), *(_reduce(q, turns) for q in _blocks(quaternions))])
    _keep(np.arange(len(reduced)), _Images(reduced, turns, float(2 * np.sin(tolerance / 4))), first)
    return [int(j) for j in first]


@dataclass(frozen=True)
class _Images:
    """Orientations (N, 4) as `_reduce` turns them, and the chord on S³ within which two are the same."""

    reduced: Array
    turns: Array
    chord: float

    def of(self, kept: Indices) -> tuple[Array, Indices]:
        """Images ±q ⊗ s (M, 4) that can be within the chord of a reduced quaternion, and whose they are.

        |w| of an image next to a reduced one p is at least that of p less the chord, and no image of q has
        a |w| above that of p by more than the chord.
        """
        images, owners = [np.empty((0, 4))], [np.empty(0, dtype=np.intp)]
        for part in _blocks(kept):
            w = self.reduced[part] @ (self.turns * CONJUGATE).T
            near = np.abs(w) >= np.max(np.abs(w), axis=1, keepdims=True) - 2 * self.chord - ROUNDING
            for sign in (1.0, -1.0):
                rows, turns = np.nonzero(near & (sign * w >= -self.chord - ROUNDING))
                images.append(sign * multiply(self.reduced[part[rows]], self.turns[turns]))
                owners.append(part[rows])
        return np.concatenate(images), np.concatenate(owners)


def _blocks(rows: NDArray[Any]) -> list[NDArray[Any]]:
    return np.array_split(rows, max(1, -(-len(rows) // BLOCK)))


def _reduce(quaternions: Array, turns: Array) -> Array:
    """Of the equivalents ±q ⊗ s of each (N, 4) the one with the largest w, its least turn from none."""
    w = quaternions @ (turns * CONJUGATE).T
    best = np.argmax(np.abs(w), axis=1)
    sign = np.where(w[np.arange(len(w)), best] < 0, -1.0, 1.0)
    return multiply(sign[:, None] * quaternions, turns[best])


def _keep(rows: Indices, images: _Images, first: Indices) -> Indices:
    """Which of `rows`, none of which is the same as any kept before them, are kept; the others in `first`.

    Those kept of the first half decide about the second; what they leave of it is decided likewise.
    """
    if len(rows) <= FEW:
        return _keep_few(rows, images, first)
    kept = _keep(rows[: len(rows) // 2], images, first)
    rest = rows[len(rows) // 2 :]
    left = _match(kept, rest, images, first)
    return np.concatenate([kept, _keep(left, images, first)])


def _keep_few(rows: Indices, images: _Images, first: Indices) -> Indices:
    """The same for a few, one after another, all compared with all."""
    points, owners = images.of(rows)
    apart = np.linalg.norm(images.reduced[rows][:, None, :] - points[None, :, :], axis=2)
    near = np.zeros((len(rows), len(rows)), dtype=bool)
    at, image = np.nonzero(apart <= images.chord)
    near[at, np.searchsorted(rows, owners[image])] = True
    kept = np.zeros(len(rows), dtype=bool)
    for i, row in enumerate(rows):
        before = np.flatnonzero(near[i, :i] & kept[:i])
        kept[i] = not len(before)
        first[row] = row if kept[i] else rows[before[0]]
    return rows[kept]


def _match(kept: Indices, rest: Indices, images: _Images, first: Indices) -> Indices:
    """Those of `rest` that are the same as none of `kept`; the others get the first one in `first`."""
    from scipy.spatial import cKDTree

    points, owners = images.of(kept)
    tree, free = cKDTree(points), np.ones(len(rest), dtype=bool)
    for part in _blocks(np.arange(len(rest))):
        found = tree.query_ball_point(images.reduced[rest[part]], images.chord, return_length=True)
        hit = part[np.asarray(found) > 0]
        near = tree.query_ball_point(images.reduced[rest[hit]], images.chord)
        first[rest[hit]] = [int(np.min(owners[one])) for one in near]
        free[hit] = False
    return rest[free]
