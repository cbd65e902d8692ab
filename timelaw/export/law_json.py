"""`law.json`: the motion, its nodes and its certificate; the file alone is enough to verify it."""

import json
import platform
from importlib.metadata import version
from typing import Any

from timelaw import __version__
from timelaw.certificate import Certificate
from timelaw.errors import Fault, InputError
from timelaw.files import replace_unbounded
from timelaw.law_file.document import to_document
from timelaw.law_file.read import find_excess
from timelaw.motion import QuaternionLaw

SOLVER_PACKAGES = ("casadi", "numpy")


def format_law(law: QuaternionLaw, certificate: Certificate, provenance: dict[str, Any]) -> str:
    """The text of the law file. Python writes each double with the digits that read back bit for bit.

    In what is said of the motion null stands for a number that is not finite; the motion itself has none.

    Raises:
        InputError: the file would be too large to be read again.
    """
    motion = to_document(law)
    document: dict[str, Any] = {
        **{k: motion[k] for k in ("format", "version", "name")},
        "timelaw": __version__,
        **{k: v for k, v in motion.items() if k not in ("format", "version", "name")},
        "nodes": replace_unbounded([node.to_dict() for node in certificate.continuity.nodes]),
        "certificate": replace_unbounded(certificate.to_dict()),
        "provenance": replace_unbounded({**provenance, **list_versions()}),
    }
    text = _layout(document) + "\n"
    excess = find_excess(text)
    if excess:
        raise InputError(
            Fault(f"law.json would hold {excess}: fewer intervals, or two motions of it", "easing")
        )
    return text


def list_versions() -> dict[str, Any]:
    """Versions of what computed the law."""
    packages = {name: version(name) for name in SOLVER_PACKAGES}
    return {"versions": {"timelaw": __version__, "python": platform.python_version(), **packages}}


def _layout(document: dict[str, Any]) -> str:
    """One line per key, and one per entry of a list of objects: small, and readable in a diff."""
    lines = []
    for key, value in document.items():
        if isinstance(value, list):
            entries = ",\n".join("  " + json.dumps(entry, allow_nan=False) for entry in value)
            lines.append(f' "{key}": [\n{entries}\n ]')
        else:
            lines.append(f' "{key}": {json.dumps(value, allow_nan=False)}')
    return "{\n" + ",\n".join(lines) + "\n}"
