"""The comparison report: verdict, laws side by side, pictures, continuity, and how it was solved."""

from timelaw.report.html import report_files
from timelaw.report.summary import LawRow, law_rows

__all__ = ["LawRow", "law_rows", "report_files"]
