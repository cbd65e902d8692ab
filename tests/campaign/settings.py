"""Seeded limits, bodies, easings and continuity."""

import numpy as np

RATE_UNITS = {"velocity": "/s", "acceleration": "/s^2", "jerk": "/s^3", "snap": "/s^4"}
DEGREE = np.pi / 180


def quantity(rng, value: float, unit: str) -> str:
    """A value in SI as text: in degrees or radians, with all digits or few."""
    if unit.startswith("/") and rng.random() < 0.5:
        value, unit = value / DEGREE, "deg" + unit
    elif unit.startswith("/"):
        unit = "rad" + unit
    return f"{float(value)!r} {unit}" if rng.random() < 0.5 else f"{float(f'{value:.3g}')!r} {unit}"


def bound(rng, value: float, unit: str, by_axis: float):
    """A norm, or with that probability three axes."""
    if rng.random() >= by_axis:
        return quantity(rng, value, unit)
    return [quantity(rng, value * f, unit) for f in 10 ** rng.uniform(-0.7, 0.7, size=3)]


def sizes(rng) -> dict[str, float]:
    """Rates that suit each other, or any over eight decades."""
    if rng.random() < 0.4:
        return {name: float(10 ** rng.uniform(-4, 4)) for name in RATE_UNITS}
    scale = 10 ** rng.uniform(-2, 2)
    return {name: float(10 ** rng.uniform(-1, 1.2) * scale**-k) for k, name in enumerate(RATE_UNITS, 1)}


def continuity(rng, least: int = 1) -> int:
    """Two mostly."""
    return max(int(rng.choice([1, 2, 3, 4], p=[0.12, 0.6, 0.2, 0.08])), least)


def limits(rng, r: int, *, by_axis: float = 0.15, snap: bool = False) -> dict:
    """Some of velocity, acceleration and jerk, and snap if that is asked for."""
    names = ["velocity", "acceleration"] + (["jerk"] if r >= 2 else [])
    if rng.random() < 0.4:
        names = [str(n) for n in rng.choice(names, size=int(rng.integers(1, len(names) + 1)), replace=False)]
    names += ["snap"] if snap else []
    size = sizes(rng)
    return {name: bound(rng, size[name], RATE_UNITS[name], by_axis) for name in RATE_UNITS if name in names}


def body(rng, *, wheels: bool, spin: bool) -> dict:
    """An inertia that a body can have; wheels with or without a total momentum."""
    a, b = 10 ** rng.uniform(-1, 1, size=2)
    c = rng.uniform(max(abs(a - b), 0.05 * (a + b)), 0.98 * (a + b))
    moments = rng.permutation([a, b, c])
    matrix: list = [f"{float(m)!r} kg*m^2" for m in moments]
    if rng.random() < 0.4:
        q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        full = q @ np.diag(moments) @ q.T
        full = (full + full.T) / 2
        matrix = [[f"{float(v)!r} kg*m^2" for v in row] for row in full]
    found: dict = {"inertia": matrix}
    if wheels:
        found["actuator"] = "wheels"
    if spin:
        found["momentum"] = [f"{float(v)!r} N*m*s" for v in rng.normal(size=3) * 0.05]
    return found


def easing(rng, r: int, small: bool, *, timed: bool, jerk: bool) -> dict:
    """Any basis that the rest of the problem allows."""
    kind = rng.random()
    if kind < 0.12 and not timed and (r == 1 or (r == 2 and jerk)):
        return {"basis": "double-s"}
    if kind < 0.16 and not small:
        return {"basis": "auto"} | (
            {"within": str(rng.choice(["1 %", "0.1 %", "5 %"]))} if rng.random() < 0.6 else {}
        )
    if kind < (0.3 if small else 0.5):
        degree = int(rng.integers(max(3, r + 1), 8))
        fewest = max(1, 2 * (r + 1) - degree)
        most = 12 if small else int(rng.choice([12, 28, 50, 70, 200], p=[0.3, 0.3, 0.25, 0.1, 0.05]))
        return {
            "basis": "spline",
            "degree": degree,
            "intervals": int(rng.integers(fewest, max(most, fewest) + 1)),
        }
    if rng.random() < 0.3:
        return {"basis": "polynomial"}
    least = max(5, 2 * r + 1)
    most = max(least, 9) if small or rng.random() < 0.7 else 31
    return {"basis": "polynomial", "degree": int(rng.integers(least, most + 1))}
