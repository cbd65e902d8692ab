"""Files other programs read: the law file and its samples, each written whole or not at all."""

from timelaw.export.law_json import format_law
from timelaw.export.samples_csv import format_samples

__all__ = ["format_law", "format_samples"]
