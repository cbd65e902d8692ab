"""The one array type: NumPy's, of doubles. Shapes are said where an array is used."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def freeze(array: Array) -> Array:
    """A copy that cannot be written to; the array it is of stays as it was."""
    copy = np.array(array, dtype=float)
    copy.setflags(write=False)
    return copy
