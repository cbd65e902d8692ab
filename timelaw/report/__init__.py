"""The comparison report: verdict, laws side by side, pictures, continuity, and how it was solved."""

from timelaw.report.page import render_report
from timelaw.report.summary import LawRow, list_law_rows

__all__ = ["LawRow", "list_law_rows", "render_report"]
