"""Four orientations, and how a file of them is written, read, refused and compared."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from tests.laws import angles_between
from timelaw.errors import InputError
from timelaw.orientations import read_orientations

SOME = unit_quaternions(np.random.default_rng(11), 4)
TURNS = Rotation.from_quat(SOME, scalar_first=True)
PLACES = np.array([[1.3563, 0.6305, 1.638], [1.3543, 0.6306, 1.6360], [1.35, 0.63, 1.63], [1.34, 0.62, 1.62]])
XYZW = SOME[:, [1, 2, 3, 0]]


def read(folder, name, content, more=""):
    data = content if isinstance(content, bytes) else content.encode()
    (folder / name).write_bytes(data)
    made = problem(f"route: {{orientations: {{file: {name}{more}}}}}")
    return read_orientations(made.route.orientations, folder)


def refuse(folder, name, content, message, more=""):
    with pytest.raises(InputError) as error:
        read(folder, name, content, more)
    assert message in str(error.value)
    assert name in str(error.value)


def same(found, expected=SOME, atol=1e-12):
    assert len(found) == len(expected)
    assert np.max(angles_between(found.quaternions, expected)) < atol


def rows(*columns, sep=" ", digits=".17g"):
    table = np.column_stack(columns)
    return "\n".join(sep.join(format(v, digits) for v in row) for row in table.tolist()) + "\n"
