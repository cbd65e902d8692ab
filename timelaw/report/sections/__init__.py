"""The sections of the report, in the order of the page: each a file here and a template."""

from timelaw.report.section import Section
from timelaw.report.sections import (
    continuity,
    easings,
    geometry,
    laws,
    limits,
    provenance,
    rates,
    solved,
    verdict,
)

SECTIONS: tuple[Section, ...] = (
    verdict.SECTION,
    laws.SECTION,
    rates.SECTION,
    limits.SECTION,
    easings.SECTION,
    continuity.SECTION,
    solved.SECTION,
    geometry.SECTION,
    provenance.SECTION,
)
