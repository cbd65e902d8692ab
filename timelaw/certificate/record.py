"""What a law file says of itself, compared with what its motion shows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

from timelaw.certificate.certificate import Certificate
from timelaw.certificate.continuity import NodeReport
from timelaw.certificate.limit_check import LegPeak, LimitCheck
from timelaw.certificate.translation import NAMES, Crossing, Translation
from timelaw.motion.segment import RATES

RECORD_TOLERANCE = 1e-9  # relative; other machines round the same sums a little differently
DURATION_TOLERANCE = 1e-12  # relative; a sum of rounded numbers
NOISE = 1e-12  # of a limit, or of the largest rate of its order; below it a number is rounding alone
OPTIONAL = ("legs", "continuity_inside_segments", "translation")  # not in the contract
TURN_TOLERANCE = 1e-9  # rad; of the turn of the axis at a node
MOTION = (
    "format",
    "version",
    "name",
    "conventions",
    "limits",
    "continuity",
    "body",
    "outside",
    "periodic",
    "segments",
)
WITNESSES = (  # of equal peaks another machine may name another one first; the rest is rounding itself
    "certificate.limits.time",
    "certificate.limits.segment",
    "certificate.legs.limits.time",
    "certificate.checks.worst",
)


@dataclass(frozen=True)
class Compared:
    """Which parts of a file's own record were compared with its motion, and which were not."""

    compared: tuple[str, ...]
    not_compared: tuple[str, ...]

    @property
    def sentence(self) -> str:
        """As the command line says it."""
        rest = f"; not compared: {', '.join(self.not_compared)}" if self.not_compared else ""
        if not self.compared:
            return "the file has no record of itself: nothing was compared" + rest
        return f"compared with the file's own record: {', '.join(self.compared)}{rest}"


def list_compared(document: Mapping[str, Any]) -> Compared:
    """The parts of a law file's record that `compare_with_record` looks at, and the others by name."""
    recorded = document.get("certificate")
    given = recorded if isinstance(recorded, dict) else {}
    compared = [f"certificate.{key}" for key in given if key in (*_PARTS, "digest")]
    compared = (["nodes"] if "nodes" in document else []) + compared
    unknown = [key for key in document if key not in (*MOTION, "duration", "nodes", "certificate")]
    unknown += [f"certificate.{key}" for key in given if key not in (*_PARTS, "digest")]
    unknown += [witness for witness in WITNESSES if witness.split(".")[1] in given]
    return Compared(("duration", *compared) if compared else (), tuple(unknown))


def compare_with_record(certificate: Certificate, document: Mapping[str, Any]) -> list[str]:
    """Where a law file says other things of itself than its motion shows, one sentence each.

    Numbers are compared relative to themselves, but for what is rounding alone beside a limit or the
    largest rate of that order.
    """
    found = []
    recorded, given = document.get("certificate"), document.get("duration")
    if not _near(given, certificate.duration, relative=DURATION_TOLERANCE):
        found.append(f"the file gives a duration of {given} s, its segments take {certificate.duration} s")
    if "nodes" in document and not _match_nodes(document["nodes"], certificate):
        found.append("the nodes recorded in the file are not those of its motion")
    if recorded is None:
        return found
    if not isinstance(recorded, dict):
        return [*found, "the recorded certificate is no certificate"]
    for key, matches in _PARTS.items():
        if (key in recorded or key not in OPTIONAL) and not matches(recorded.get(key), certificate):
            found.append(f'the recorded certificate says otherwise about "{key}"')
    if recorded.get("digest") != certificate.digest:
        found.append("the motion was altered after it was certified: its digest is another")
    return found


def _near(recorded: Any, value: float, noise: float = 0.0, *, relative: float = RECORD_TOLERANCE) -> bool:
    """Equal but for rounding; null stands for what is not finite."""
    if not isfinite(value):
        return recorded is None
    if isinstance(recorded, bool) or not isinstance(recorded, int | float):
        return False
    return bool(abs(recorded - value) <= relative * max(abs(value), abs(recorded)) + noise)


def _match_each(recorded: Any, values: Sequence[Any], matches: Any) -> bool:
    """A list of as many objects, each of which matches."""
    if not isinstance(recorded, list) or len(recorded) != len(values):
        return False
    return all(isinstance(r, dict) and matches(r, value) for r, value in zip(recorded, values, strict=True))


def _match_limit(recorded: dict[str, Any], check: LimitCheck) -> bool:
    noise = NOISE * check.bound
    return (
        recorded.get("limit") == check.limit
        and recorded.get("holds") is check.holds
        and recorded.get("note", "") == check.note
        and _near(recorded.get("bound"), check.bound)
        and _near(recorded.get("peak"), check.peak, noise)
        and _near(recorded.get("upper"), check.upper, noise)
        and _near(recorded.get("margin"), check.margin, RECORD_TOLERANCE)
    )


def _match_legs(recorded: Any, certificate: Certificate) -> bool:
    legs: dict[int, list[LegPeak]] = {}
    for peak in certificate.peaks:
        legs.setdefault(peak.index, []).append(peak)
    return _match_each(recorded, list(legs.values()), _match_leg)


def _match_leg(recorded: dict[str, Any], peaks: Sequence[LegPeak]) -> bool:
    def match(limit: dict[str, Any], peak: LegPeak) -> bool:
        return (
            limit.get("limit") == peak.label
            and _near(limit.get("upper"), peak.upper, NOISE * peak.bound)
            and _near(limit.get("margin"), 1 - peak.used, RECORD_TOLERANCE)
        )

    return recorded.get("segment") == peaks[0].segment and _match_each(recorded.get("limits"), peaks, match)


def _match_check(recorded: dict[str, Any], check: Any) -> bool:
    same = recorded.get("check") == check.check and recorded.get("holds") is check.holds
    return same and _near(recorded.get("tolerance"), check.tolerance)


def _match_nodes(recorded: Any, certificate: Certificate) -> bool:
    peaks = {RATES[k]: peak for k, peak in certificate.continuity.peaks.items()}

    def match(found: dict[str, Any], node: NodeReport) -> bool:
        return (
            all(found.get(k) == getattr(node, k) for k in ("label", "kind", "continuity"))
            and _near(found.get("time"), node.time)
            and (
                found.get("turn") is None
                if node.turn is None
                else _near(found.get("turn"), node.turn, TURN_TOLERANCE)
            )
            and _match_rates(found, node, peaks)
        )

    return _match_each(recorded, certificate.continuity.nodes, match)


def _match_rates(recorded: dict[str, Any], node: NodeReport, peaks: Mapping[str, float]) -> bool:
    """The jumps, and the rates on both sides where they are recorded: the contract does not ask for them."""
    jumps = recorded.get("jump")
    if not isinstance(jumps, dict):
        return False
    for name, size in node.jump.items():
        if name in jumps and not _near(jumps[name], size, NOISE * peaks[name]):
            return False
    for side, rates in (("before", node.before), ("after", node.after)):
        given = recorded.get(side, {})
        for name, rate in rates.items() if isinstance(given, dict) else ():
            components = given.get(name)
            if components is None:
                continue
            if not (isinstance(components, list) and len(components) == len(rate)):
                return False
            if not all(_near(c, v, NOISE * peaks[name]) for c, v in zip(components, rate, strict=True)):
                return False
    return True


def _match_translation(recorded: Any, translation: Translation | None) -> bool:
    """The classes of the origin's way, and its jumps at the nodes."""
    if translation is None or not isinstance(recorded, dict):
        return False

    def match(found: dict[str, Any], node: Crossing) -> bool:
        jump = found.get("jump")
        return (
            found.get("label") == node.label
            and isinstance(jump, dict)
            and all(
                _near(jump.get(NAMES[k]), size, size * NOISE / part if part else 0.0)
                for (k, size), part in zip(node.jump.items(), node.parts.values(), strict=True)
            )
        )

    return (
        _near(recorded.get("continuity"), float(translation.order))
        and _near(recorded.get("continuity_inside_segments"), float(translation.inside))
        and _match_each(recorded.get("nodes"), translation.nodes, match)
    )


_PARTS: dict[str, Any] = {  # of a recorded certificate, each with what compares it
    "holds": lambda recorded, certificate: recorded is certificate.holds,
    "limits": lambda recorded, c: _match_each(recorded, c.limits, _match_limit),
    "legs": _match_legs,
    "checks": lambda recorded, c: _match_each(recorded, c.geometry, _match_check),
    "continuity": lambda recorded, c: _near(recorded, float(c.order)),
    "continuity_inside_segments": lambda recorded, c: _near(recorded, float(c.continuity.inside)),
    "translation": lambda recorded, c: _match_translation(recorded, c.translation),
}
