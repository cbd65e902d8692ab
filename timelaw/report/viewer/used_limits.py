"""The limits of a law as the page shows their use: what each bounds, where, and its proved peak."""

from typing import Any

from timelaw.certificate import Certificate
from timelaw.limits import make_limits
from timelaw.limits.bounds import AXES, Bounds
from timelaw.motion import QuaternionLaw
from timelaw.motion.deviation import DEVIATION, DeviationRow
from timelaw.units import convert, name_unit

WORLD = "linear_"  # how the limits begin that are about the axes of the world


def list_used_limits(law: QuaternionLaw, certificate: Certificate) -> list[dict[str, Any]]:
    """Each limit, or axis of it: its general bound, and by the numbers of segments their own, in SI."""
    found: dict[tuple[str, int | None], dict[str, Any]] = {}
    units = {limit.name: limit.unit for limit in make_limits(law.limits, law.body)}
    for number, given in [(None, law.limits), *enumerate(s.limits for s in law.segments)]:
        units |= {limit.name: limit.unit for limit in make_limits(given, law.body)}
        for name, bounds in given.items():
            for axis, bound in _split(bounds):
                entry = found.setdefault((name, axis), {"bound": None, "own": {}})
                if number is None:
                    entry["bound"] = bound
                else:
                    entry["own"][number] = bound
    peaks = _list_peaks(certificate)
    return [
        {
            "name": name,
            "axis": axis,
            "label": _describe(name, axis),
            "peak": peaks.get(_label(name, axis), 0.0),
            "unit": name_unit(unit, degrees=True),
            "factor": convert(1.0, unit, degrees=True),
            **entry,
        }
        for (name, axis), entry in found.items()
        for unit in [DeviationRow.unit if name == DEVIATION else units[name]]
    ]


def _split(bounds: Bounds) -> list[tuple[int | None, float]]:
    """A norm's bound, or those of the axes by number."""
    return list(enumerate(bounds)) if isinstance(bounds, tuple) else [(None, bounds)]


def _label(name: str, axis: int | None) -> str:
    """As the certificate has it."""
    return name if axis is None else f"{name} {AXES[axis]}"


def _describe(name: str, axis: int | None) -> str:
    """As a reader finds it."""
    words = name.replace("_", " ")
    if axis is None:
        return words
    return f"{words}, {'world' if name.startswith(WORLD) else 'body'} axis {AXES[axis]}"


def _list_peaks(certificate: Certificate) -> dict[str, float]:
    """By label the largest proved peak over its limit, on whatever leg."""
    peaks: dict[str, float] = {}
    for check in certificate.limits:
        label = check.limit.split(" on ")[0]
        peaks[label] = max(peaks.get(label, 0.0), check.ratio)
    return peaks
