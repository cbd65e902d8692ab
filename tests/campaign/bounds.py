"""What limits demand, twice: of the vectors ω, α, jerk, snap, and of the travelled angle on one leg."""

from dataclasses import dataclass
from math import inf

import numpy as np

from tests.campaign.attitude import to_body
from tests.campaign.spec import RATES, Body, Spec, leg_limits


def _ratio(vector, bound):
    """Part of a bound that vectors (m, 3) take."""
    if np.ndim(bound):
        return np.max(np.abs(vector) / bound, axis=-1)
    return np.linalg.norm(vector, axis=-1) / bound


def used_parts(limits: dict, body: Body | None, rates: dict, attitude=None, first=None) -> dict:
    """By limit, the part (m,) of it that is used; `rates[k]` (m, 3), `attitude` (m, 4), `first` the one at t = 0."""
    parts = {}
    for name, bound in limits.items():
        if name in RATES:
            parts[name] = _ratio(rates[RATES[name]], bound)
            continue
        stored = rates[1] @ body.inertia.T
        total = np.zeros(3)
        if body.wheels and np.any(body.momentum):
            total = to_body(attitude, _to_world(first, body.momentum))
        if name == "momentum":
            parts[name] = _ratio(total - stored if body.wheels else stored, bound)
        else:
            carried = total if body.wheels else stored
            parts[name] = _ratio(rates[2] @ body.inertia.T + np.cross(rates[1], carried), bound)
    return parts


def _to_world(q, vector):
    return to_body(np.array([q[0], -q[1], -q[2], -q[3]]), vector)


@dataclass(frozen=True)
class Ceiling:
    """Bounds on |φ'|, |φ''|, |φ'''|, |φ''''|, inf for none; `whole` if they are all there is on the leg."""

    rates: tuple[float, float, float, float]
    whole: bool

    @property
    def by_order(self) -> dict[int, float]:
        """The finite ones."""
        return {k: b for k, b in enumerate(self.rates, 1) if b < inf}


def _least(bound, vector) -> float:
    size = np.abs(vector) if np.ndim(bound) else np.linalg.norm(vector)
    with np.errstate(divide="ignore"):
        return float(np.min(np.asarray(bound) / size))


def ceiling(sets: list[dict], body: Body | None, axis) -> Ceiling:
    """What no motion about `axis` may exceed; for torque with a part in φ'² more than that is demanded."""
    rates, whole = [inf] * 4, True
    for name, bound in (item for limits in sets for item in limits.items()):
        if name in RATES:
            order, value = RATES[name], _least(bound, axis)
        else:
            linear, turning = body.inertia @ axis, np.cross(axis, body.inertia @ axis)
            total = float(np.linalg.norm(body.momentum)) if body.wheels else 0.0
            if name == "momentum":
                order, value = 1, _least(np.asarray(bound) - total, linear)
            else:
                coupled = (
                    total > 0 if body.wheels else np.linalg.norm(turning) > 1e-12 * np.linalg.norm(linear)
                )
                whole = whole and not coupled
                free = np.ndim(bound) and coupled and not body.wheels  # by axis φ'² may help φ''
                order, value = 2, inf if free else _least(bound, linear)
        rates[order - 1] = min(rates[order - 1], value)
    return Ceiling(tuple(rates), whole)


def demanded(sets: list[dict], body: Body | None, axis, phi: dict[int, np.ndarray]) -> float:
    """The largest part of a limit that rates φ', φ'', … (m,) use, H counted in full as documented."""
    vectors = {k: np.asarray(v)[:, None] * axis for k, v in phi.items()}
    worst = 0.0
    for limits in sets:
        calm = {k: v for k, v in limits.items() if k in RATES or not (body.wheels and np.any(body.momentum))}
        worst = max([worst, *(float(np.max(v)) for v in used_parts(calm, body, vectors).values())])
        for name in set(limits) - set(calm):
            bound, linear, total = limits[name], body.inertia @ axis, float(np.linalg.norm(body.momentum))
            by_axis = bool(np.ndim(bound))
            size = np.abs(linear) if by_axis else np.linalg.norm(linear)
            if name == "momentum":
                used = np.abs(phi[1])[:, None] * size + total
            else:
                aslant = np.sqrt(np.clip(1 - np.asarray(axis) ** 2, 0, None)) if by_axis else 1.0
                used = np.abs(phi[2])[:, None] * size + aslant * total * np.abs(phi[1])[:, None]
            worst = max(worst, float(np.max(used / bound)))
    return worst


def sets_on(spec: Spec, origin: str, target: str) -> list[dict]:
    """The sets of limits on a leg of the tour."""
    return leg_limits(spec, origin, target)
