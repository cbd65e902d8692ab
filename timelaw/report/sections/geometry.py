"""Do the segments meet their nodes, and their times add up?"""

from timelaw.report.section import Section

SECTION = Section("Checks of the geometry", "geometry.html", lambda _: {})
