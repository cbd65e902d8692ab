"""The registry of formats in which a law leaves for other programs."""

from collections.abc import Callable
from dataclasses import dataclass

from timelaw.export.samples_csv import format_samples
from timelaw.motion import QuaternionLaw


@dataclass(frozen=True)
class Exporter:
    """A format: the usual name of its file, and the content for a law at so many samples per second."""

    file_name: str
    write: Callable[[QuaternionLaw, float], str | bytes]


EXPORTERS: dict[str, Exporter] = {
    "csv": Exporter("samples.csv", format_samples),
}
