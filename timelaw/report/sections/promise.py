"""What is proved, with what tolerances, and what is not promised."""

from timelaw.report.section import Section

SECTION = Section("What is proved, and what is not promised", "promise.html", lambda _: {})
