"""Attitude files of space flight as orientations: CCSDS AEM (.aem) and STK (.a), by their endings."""

from collections.abc import Callable
from pathlib import Path

from timelaw.numerics.array import Array
from timelaw.orientations.aem import read_aem
from timelaw.orientations.stk import read_stk

ATTITUDE_READERS: dict[str, Callable[[Path], tuple[Array, tuple[str, ...]]]] = {
    ".aem": read_aem,
    ".a": read_stk,
}
