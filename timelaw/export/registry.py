"""The registry of formats, by the name that users give them."""

from timelaw.export.exporter import Exporter
from timelaw.export.samples_csv import CSV

EXPORTERS: dict[str, Exporter] = {
    "csv": CSV,
}
