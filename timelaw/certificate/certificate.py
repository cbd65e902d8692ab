"""The certificate of a law: all that is proved of it."""

import hashlib
import json
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from timelaw.certificate.continuity import Continuity, check_continuity
from timelaw.certificate.geometry_check import GeometryCheck, check_geometry
from timelaw.certificate.limit_check import LegPeak, LimitCheck, check_limits, find_leg_peaks
from timelaw.certificate.translation import Translation, check_translation, list_linear_jumps
from timelaw.law_file.document import to_document
from timelaw.motion import QuaternionLaw
from timelaw.motion.segment import MAX_ORDER, RATES


@dataclass(frozen=True)
class Certificate:
    """What is proved of one law. It holds if every limit and every geometric check does.

    `peaks` say how near each limit each segment comes, and when. `translation` is of the body's origin where
    that moves too, `linear_jumps` are the limits on it that cannot hold.
    """

    limits: tuple[LimitCheck, ...]
    peaks: tuple[LegPeak, ...]
    geometry: tuple[GeometryCheck, ...]
    continuity: Continuity
    duration: float
    digest: str
    asked: int = 0
    translation: Translation | None = None
    linear_jumps: tuple[str, ...] = ()

    @property
    def order(self) -> int:
        """C^k of the whole motion, the way of the body's origin included."""
        return min(self.continuity.order, self.translation.order if self.translation else MAX_ORDER)

    @property
    def holds(self) -> bool:
        """Whether nothing was found."""
        return not self.findings()

    @property
    def limits_hold(self) -> bool:
        """Whether every limit holds for all t, whatever continuity was asked for."""
        return not self.limit_findings()

    def findings(self) -> list[str]:
        """What is wrong with the law, one sentence each."""
        found = self.limit_findings()
        if self.order < self.asked:
            found.append(f"the motion is C{self.order}, C{self.asked} was asked for")
        found += [
            f"{g.check}: off by {' '.join([f'{g.worst:.3g}', *g.unit.split()])} at {g.where}, "
            f"{g.tolerance:.1g} is tolerated"
            for g in self.geometry
            if not g.holds
        ]
        return found

    def limit_findings(self) -> list[str]:
        """Limits that are broken, the worst first, and jumps where one cannot hold."""
        found = [
            f"{c.limit} reaches {c.peak:.9g} {c.unit} in {c.segment} at t = {c.time:.6f} s, "
            f"over the limit of {c.bound:.9g} {c.unit} by {-c.margin:.2e} of it"
            for c in sorted(self.limits, key=lambda c: c.margin)
            if not c.holds
        ]
        return [*found, *self._jumps(), *self.linear_jumps]

    def _jumps(self) -> list[str]:
        """Limits of order k where a lower rate jumps: the limited rate is unbounded there."""
        highest = max((c.order for c in self.limits), default=0)
        if self.continuity.order >= highest - 1:
            return []
        rate = RATES[self.continuity.order + 1]
        worst = max(self.continuity.nodes, key=lambda node: node.jump[rate])
        place = f"at node {worst.label}" if worst.continuity == self.continuity.order else "inside a segment"
        return [f"{rate} jumps {place}, where a limit on one of its derivatives cannot hold"]

    def to_dict(self) -> dict[str, Any]:
        """As the law file has it."""
        return {
            "holds": self.holds,
            "limits": [
                {
                    "limit": c.limit,
                    "bound": c.bound,
                    "peak": c.peak,
                    "upper": c.upper,
                    "time": c.time,
                    "segment": c.segment,
                    "margin": c.margin,
                    "holds": c.holds,
                    **({"note": c.note} if c.note else {}),
                }
                for c in self.limits
            ],
            "checks": [
                {"check": g.check, "worst": g.worst, "tolerance": g.tolerance, "holds": g.holds}
                for g in self.geometry
            ],
            "legs": [
                {"segment": legs[0].segment, "limits": [leg.to_dict() for leg in legs]}
                for legs in (list(group) for _, group in groupby(self.peaks, key=lambda leg: leg.index))
            ],
            "continuity": self.order,
            "continuity_inside_segments": self.continuity.inside,
            **({"translation": self.translation.to_dict()} if self.translation else {}),
            "digest": self.digest,
        }


def certify(law: QuaternionLaw) -> Certificate:
    """Prove what can be proved of a law from its own numbers; nothing is sampled."""
    peaks, translation = find_leg_peaks(law), check_translation(law)
    return Certificate(
        check_limits(peaks),
        peaks,
        (*check_geometry(law), *([translation.check] if translation else [])),
        check_continuity(law),
        law.duration,
        digest_motion(to_document(law)),
        law.continuity,
        translation,
        tuple(list_linear_jumps(law, translation)) if translation else (),
    )


def digest_motion(document: dict[str, Any]) -> str:
    """SHA-256 over the motion as the law file defines it, every number as the double it is."""
    text = json.dumps(_as_doubles(document), sort_keys=True, separators=(",", ":"))
    return "sha256:" + hashlib.sha256(text.encode()).hexdigest()


def _as_doubles(data: Any) -> Any:
    """Every number as a float, so that 1 and 1.0 are the same."""
    if isinstance(data, dict):
        return {k: _as_doubles(v) for k, v in data.items()}
    if isinstance(data, list):
        return [v if isinstance(v, float) else _as_doubles(v) for v in data]
    return float(data) if isinstance(data, int) and not isinstance(data, bool) else data
