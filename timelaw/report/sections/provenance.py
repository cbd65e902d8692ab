"""From which problem file, by which versions, under which conventions."""

import platform
from importlib.metadata import version
from pathlib import Path
from typing import Any

from timelaw import __version__
from timelaw.report.section import Facts, Section

PACKAGES = ("casadi", "numpy", "matplotlib")


def _context(facts: Facts) -> dict[str, Any]:
    return {
        "digest": facts.digest,
        "snap": "snap" in facts.design.optimised.law.limits,
        "file": Path(facts.design.path).name,
        "versions": list_versions(),
    }


def list_versions() -> dict[str, str]:
    """Of what computed and drew it."""
    own = {"timelaw": __version__, "Python": platform.python_version()}
    return own | {name: version(name) for name in PACKAGES}


SECTION = Section("Provenance", "provenance.html", _context)
