"""Every limit with its proved peak."""

from timelaw.report.section import Section

SECTION = Section("Limits", "limits.html", lambda _: {})
