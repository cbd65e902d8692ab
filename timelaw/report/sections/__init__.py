"""The sections of the report, in the order of the page: each a file here and a template."""

from importlib import import_module

from timelaw.report.section import Section

ORDER = (
    "verdict",
    "problem",
    "laws",
    "motion",
    "pictures",
    "rates",
    "limits",
    "passing",
    "easings",
    "continuity",
    "solved",
    "promise",
    "provenance",
)
SECTIONS: tuple[Section, ...] = tuple(import_module(f"{__name__}.{name}").SECTION for name in ORDER)
