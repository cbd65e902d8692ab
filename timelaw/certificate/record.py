"""What a law file says of itself, compared with what its motion shows."""

from math import isfinite
from typing import Any

from timelaw.certificate.certificate import Certificate

RECORD_TOLERANCE = 1e-9  # relative; other machines round the same sums a little differently
WITNESS = ("time", "segment")  # of equal peaks another machine may name another one first
OPTIONAL = ("before", "after", "worst")  # not in the contract, or rounding noise itself


def compare_with_record(certificate: Certificate, document: dict[str, Any]) -> list[str]:
    """Where a law file says other things of itself than its motion shows, one sentence each."""
    found = []
    recorded = document.get("certificate")
    given = document.get("duration")
    if not (isinstance(given, float | int) and abs(given / certificate.duration - 1) <= RECORD_TOLERANCE):
        found.append(f"the file gives a duration of {given} s, its segments take {certificate.duration} s")
    nodes = [node.to_dict() for node in certificate.continuity.nodes]
    if "nodes" in document and not _close(document["nodes"], nodes):
        found.append("the nodes recorded in the file are not those of its motion")
    if recorded is None:
        return found
    if not isinstance(recorded, dict):
        return [*found, "the recorded certificate is no certificate"]
    known = {k: v for k, v in certificate.to_dict().items() if k != "digest"}
    known["limits"] = [{k: v for k, v in c.items() if k not in WITNESS} for c in known["limits"]]
    for key, value in known.items():
        if not _close(recorded.get(key), value):
            found.append(f'the recorded certificate says otherwise about "{key}"')
    if recorded.get("digest") != certificate.digest:
        found.append("the motion was altered after it was certified: its digest is another")
    return found


def _close(recorded: Any, value: Any) -> bool:
    """Equal but for what is optional, with numbers equal up to rounding."""
    if isinstance(value, dict):
        return isinstance(recorded, dict) and all(
            _close(recorded.get(k), v) for k, v in value.items() if k in recorded or k not in OPTIONAL
        )
    if isinstance(value, list):
        return (
            isinstance(recorded, list)
            and len(recorded) == len(value)
            and all(_close(r, v) for r, v in zip(recorded, value, strict=True))
        )
    if isinstance(value, bool) or isinstance(recorded, bool):
        return value is recorded
    if isinstance(value, float) and not isfinite(value):
        return recorded is None  # JSON has no other word for it
    if isinstance(value, float) and isinstance(recorded, int | float):
        return abs(recorded - value) <= RECORD_TOLERANCE * max(abs(value), abs(recorded), 1.0)
    return bool(recorded == value)
