"""Files other programs read: the law file and its samples, each written whole or not at all."""

from timelaw.export.law_json import law_json
from timelaw.export.samples_csv import samples_csv

__all__ = ["law_json", "samples_csv"]
