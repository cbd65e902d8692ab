"""The picture of the rates over time."""

from timelaw.report.section import Section

SECTION = Section("Rates over time", "rates.html", lambda _: {})
