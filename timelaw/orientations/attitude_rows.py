"""What files of attitudes have in common: rotation sequences by number, norms, joints that repeat."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import angle_between
from timelaw.orientations.rows import make_fault

AXES = {"1": "X", "2": "Y", "3": "Z", "X": "X", "Y": "Y", "Z": "Z"}
SHORTEST = 1e-3  # of a quaternion whose direction is worth anything
AS_GIVEN = 1e-3  # by which a norm may differ from one before it is told
SAME = 1e-9  # rad; of an attitude that stands at the end of one segment and the start of the next


def read_sequence(text: str, path: Path, line: int) -> str:
    """SciPy's name of a rotation sequence such as 321, of turns about the axes as they are then.

    Raises:
        InputError: it is no sequence of three axes, two in a row alike.
    """
    found = "".join(AXES.get(letter, "?") for letter in text.strip().upper())
    if len(found) != 3 or "?" in found or found[0] == found[1] or found[1] == found[2]:
        raise make_fault(f'"{text.strip()}" is no sequence of three turns such as 321', path, line)
    return found


def normalise_rows(rows: Array, lines: Sequence[int], path: Path) -> tuple[Array, tuple[str, ...]]:
    """Quaternions (N, 4) over their norms, and a note where these are not one.

    Raises:
        InputError: one is too short to have a direction.
    """
    norms = np.linalg.norm(rows, axis=1)
    worst = int(np.argmin(norms))
    if norms[worst] < SHORTEST:
        raise make_fault(f"a quaternion of norm {norms[worst]:.3g} has no direction", path, lines[worst])
    off = float(np.max(np.abs(norms - 1)))
    note = f"norms of the quaternions in {path.name} are off by up to {off:.1g}: each is divided by its own"
    return rows / norms[:, None], (note,) if off > AS_GIVEN else ()


def join_segments(parts: Sequence[Array]) -> Array:
    """All rows, an attitude that repeats where two segments meet taken once."""
    found = [parts[0]]
    for part in parts[1:]:
        again = float(angle_between(found[-1][-1], part[0])) <= SAME
        rest = part[1:] if again else part
        if len(rest):
            found.append(rest)
    return np.concatenate(found)
