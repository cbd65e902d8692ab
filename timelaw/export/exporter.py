"""What a format is in which a law leaves for other programs."""

from collections.abc import Callable
from dataclasses import dataclass

from timelaw.motion import QuaternionLaw


@dataclass(frozen=True)
class Exporter:
    """The usual name of its file, and the content for a law at so many samples per second.

    `usual` ones are among the results of every design.
    """

    file_name: str
    write: Callable[[QuaternionLaw, float], str | bytes]
    usual: bool = False
