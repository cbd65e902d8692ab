"""Which orientations of a set are the same: up to sign, and up to the rotations of a crystal class."""

from difflib import get_close_matches
from typing import Any, cast

import numpy as np

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
    orientation is kept if it is the same as none kept before it.
    """
    from scipy.spatial import cKDTree

    tree = cKDTree(quaternions)
    chord = 2 * np.sin(tolerance / 4)
    near: list[set[int]] = [set() for _ in quaternions]
    for turn in np.eye(4)[:1] if group is None else group:
        turned = multiply(quaternions, turn)
        for sign in (1.0, -1.0):
            for i, found in enumerate(tree.query_ball_point(sign * turned, chord)):
                near[i].update(j for j in found if j < i)
    first = list(range(len(quaternions)))
    for i, before in enumerate(near):
        first[i] = min((j for j in before if first[j] == j), default=i)
    return first
