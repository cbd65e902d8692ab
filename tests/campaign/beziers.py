"""Seeded Bézier curves: what a problem file says under `route`, and the problems along them."""

from math import pi

import numpy as np
from scipy.spatial.transform import Rotation

from tests.campaign import settings
from tests.campaign.attitude import about, product, unit
from tests.campaign.scenes import random_axis

Curve = tuple[np.ndarray, np.ndarray | None, str]  # control quaternions of any length, points, translation
FORMS = ("wxyz", "xyzw", "rotation-vector", "axis-angle", "euler", "matrix")
MOST_CONTROL, MOST_POINTS = 64, 200  # of a piece of a law
LINEAR_UNITS = {"linear_velocity": 1, "linear_acceleration": 2}


def draw_turns(rng, degree: int) -> np.ndarray:
    """Control quaternions: a walk, half a turn wide, tiny, about one axis, or one that nearly comes back."""
    way = str(
        rng.choice(["walk", "wide", "tiny", "axis", "cusp", "weighted"], p=[0.35, 0.15, 0.1, 0.1, 0.15, 0.15])
    )
    start = unit(rng.normal(size=4))
    if way == "axis":
        angles = np.cumsum([0.0, *rng.uniform(-0.3, 1.5, size=degree)])
        return product(start, about(random_axis(rng), angles))
    step = {"wide": 2.0, "tiny": 10 ** rng.uniform(-6, -2)}.get(way, float(rng.uniform(0.1, 1.2)))
    points = [start]
    for _ in range(degree):
        turn = about(
            random_axis(rng),
            np.array(pi * rng.uniform(0.8, 1.0) if way == "wide" else step * rng.uniform(0.2, 1)),
        )
        points.append(product(points[-1], turn))
    control = np.array(points)
    if way == "cusp" and degree >= 2:  # the last leg of the polygon goes back nearly as the one before came
        control[-1] = unit(control[-3] + 10 ** rng.uniform(-4, -1) * rng.normal(size=4))
    if way == "weighted":
        control = control * 10 ** rng.uniform(-0.7, 0.7, size=(len(control), 1))
    return control


def draw_points(rng, start, degree: int) -> np.ndarray:
    """Points of a way: a walk, one that rests, one that nearly comes back, tiny or large."""
    size = 10 ** (rng.uniform(-1, 1) if rng.random() < 0.7 else rng.uniform(-6, 5))
    way = rng.random()
    if way < 0.06:
        return np.repeat(start[None], degree + 1, axis=0)
    points = start + np.cumsum(np.vstack([np.zeros(3), rng.normal(size=(degree, 3)) * size]), axis=0)
    if way < 0.2 and degree >= 2:
        points[-1] = points[-3] + 10 ** rng.uniform(-4, -1) * size * rng.normal(size=3)
    return points


def cut(control, u: float):
    """Both parts, by de Casteljau."""
    rows = np.array(control, dtype=float)
    left, right = [rows[0]], [rows[-1]]
    while len(rows) > 1:
        rows = (1 - u) * rows[:-1] + u * rows[1:]
        left.append(rows[0])
        right.append(rows[-1])
    return np.array(left), np.array(right[::-1])


def go_on(rng, control, order: int, degree: int, ratios: tuple[float, float]) -> np.ndarray:
    """A curve after another one: its derivatives up to `order` are those of the first, run through another way."""
    n, (first, second) = len(control) - 1, ratios
    slope = n * (control[-1] - control[-2])
    bend = n * (n - 1) * (control[-1] - 2 * control[-2] + control[-3]) if n > 1 else np.zeros_like(slope)
    scale = max(float(np.linalg.norm(control[-1] - control[0])), 1e-9)
    points = [control[-1]]
    if order >= 1:
        points.append(points[0] + first * slope / degree)
    if order >= 2:
        points.append(
            2 * points[1] - points[0] + (first**2 * bend + second * slope) / (degree * (degree - 1))
        )
    while len(points) <= degree:
        points.append(points[-1] + rng.normal(size=control.shape[1]) * scale * 0.4)
    return np.array(points)


def follow(rng, before: Curve, small: bool) -> Curve:
    """A curve that begins where another one ends, and goes on C0, C1, C2, or G1, G2."""
    control, points, translation = before
    order = int(rng.choice([0, 1, 2], p=[0.35, 0.3, 0.35]))
    degree = int(rng.integers(max(order, 1), 4 if small else 7))
    ratios = (1.0, 0.0) if rng.random() < 0.5 else (float(10 ** rng.uniform(-0.5, 0.5)), float(rng.normal()))
    plain = translation == "plain"
    if points is not None and not plain:  # P/|Q|² goes on with Q and P together
        joined = np.hstack([_raise(control, len(points)), _raise(points, len(control))])
        following = go_on(rng, joined, order, degree, ratios)
        return following[:, :4], following[:, 4:], translation
    turns = go_on(rng, control, order, degree, ratios)
    return turns, None if points is None else go_on(rng, points, order, degree, ratios), translation


def _raise(control, count: int):
    """The same curve with at least so many points."""
    rows = np.array(control, dtype=float)
    while len(rows) < count:
        n = len(rows)
        i = np.arange(1, n)[:, None]
        rows = np.vstack([rows[:1], (i * rows[:-1] + (n - i) * rows[1:]) / n, rows[-1:]])
    return rows


def draw_curves(rng, small: bool) -> list[Curve]:
    """One curve or more: cut from one, or one after the other."""
    highest = 4 if small else 7
    degree = int(rng.integers(1, highest))
    control = draw_turns(rng, degree)
    points, translation = None, str(rng.choice(["plain", "divided"]))
    if rng.random() < 0.6:
        start = np.zeros(3) if rng.random() < 0.3 else rng.normal(size=3)
        points = draw_points(rng, start, int(rng.integers(1, highest)))
    first: Curve = (control, points, translation)
    way = rng.random()
    if way < 0.4:
        return [first]
    if way < 0.65:
        u = 0.5 if rng.random() < 0.4 else float(rng.uniform(0.15, 0.85))
        turns, ways = cut(control, u), (None, None) if points is None else cut(points, u)
        other = turns[1]
        if points is None and rng.random() < 0.4:  # projective weights: the same path run through otherwise
            other = other * float(rng.uniform(0.6, 1.7)) ** np.arange(len(other))[:, None]
        return [(turns[0], ways[0], translation), (other, ways[1], translation)]
    curves = [first]
    for _ in range(int(rng.integers(1, 2 if small else 4))):
        curves.append(follow(rng, curves[-1], small))
    return curves


def write_curve(rng, curve: Curve) -> dict:
    """As a problem file has it, in one of the forms."""
    control, points, translation = curve
    sizes = np.linalg.norm(control, axis=1)
    sizes = np.clip(sizes, 1e-3, 1e3)
    form = str(rng.choice(FORMS, p=[0.5, 0.1, 0.1, 0.1, 0.1, 0.1]))
    found = _write_turns(rng, form, unit(control))
    if np.any(sizes != 1) and not (np.allclose(sizes, 1, rtol=1e-15) and rng.random() < 0.5):
        found["weights"] = sizes.tolist()
    if points is not None:
        found["points"] = [[_length(rng, x) for x in row] for row in points]
        if translation == "plain" or rng.random() < 0.5:
            found["translation"] = translation
    return found


def _write_turns(rng, form: str, q: np.ndarray) -> dict:
    if form == "wxyz":
        return {"quaternions": q.tolist()}
    if form == "xyzw":
        return {"as": form, "quaternions": q[:, [1, 2, 3, 0]].tolist()}
    turns = Rotation.from_quat(q, scalar_first=True)
    if form == "matrix":
        return {"as": form, "quaternions": turns.as_matrix().reshape(-1, 9).tolist()}
    unit_of = str(rng.choice(["deg", "rad"]))
    factor = 180 / pi if unit_of == "deg" else 1.0
    found: dict = {"as": form, "unit": unit_of}
    if form == "euler":
        found["sequence"] = str(rng.choice(["XYZ", "ZXZ", "zyx"]))
        rows = turns.as_euler(found["sequence"]) * factor
    elif form == "axis-angle":
        vectors = turns.as_rotvec()
        angles = np.linalg.norm(vectors, axis=1, keepdims=True)
        axes = vectors / np.where(angles == 0, 1, angles) * rng.uniform(0.5, 2)
        rows = np.hstack([axes, angles * factor])
    else:
        rows = turns.as_rotvec() * factor
    return found | {"quaternions": rows.tolist()}


def _length(rng, x: float) -> str:
    return f"{float(x) * 1000!r} mm" if rng.random() < 0.2 else f"{float(x)!r} m"


def limit_origin(rng, limits: dict, curves: list[Curve]) -> None:
    """Limits on the origin's rates, of the size of its way or of any."""
    points = [curve[1] for curve in curves if curve[1] is not None]
    if not points or rng.random() < 0.25:
        return
    size = max(float(np.max(np.ptp(p, axis=0))) for p in points) or 1.0
    for name, order in LINEAR_UNITS.items():
        if rng.random() < 0.7:
            value = size * 10 ** (rng.uniform(-2, 1) if rng.random() < 0.7 else rng.uniform(-4, 4))
            value = min(max(value, 1e-7), 1e5)
            scale, length = (1000.0, "mm") if rng.random() < 0.3 else (1.0, "m")
            limits[name] = settings.bound(
                rng, value * scale, f"{length}/s" + ("^2" if order == 2 else ""), 0.3
            )


def choose_easing(rng, r: int, curves: list[Curve], small: bool) -> dict:
    """A basis whose composition with the curves is not of too high a degree, or now and then one."""
    most = min(
        min((MOST_CONTROL - 1) // (len(c) - 1) for c, _, _ in curves),
        min(
            (
                (MOST_POINTS - 1) // max(len(p) - 1 + (2 * len(c) - 2) * (how == "plain"), 1)
                for c, p, how in curves
                if p is not None
            ),
            default=99,
        ),
    )
    if rng.random() < (0.2 if small else 0.45):
        degree = int(rng.integers(max(3, r + 1), 8))
        fewest = max(2, 2 * r + 3 - degree)
        return {
            "basis": "spline",
            "degree": degree,
            "intervals": int(rng.integers(fewest, max(fewest, 6 if small else 14) + 1)),
        }
    least = max(5, 2 * r + 1)
    highest = max(least, min(most, 9 if small else 15))
    if rng.random() < 0.05:
        highest = 31
    found: dict = {"basis": "polynomial"}
    return found if rng.random() < 0.2 else found | {"degree": int(rng.integers(least, highest + 1))}


def ask_too_much(rng, data: dict) -> None:
    """Something that is not to be had along curves."""
    what = int(rng.integers(4))
    if what == 0:
        data["objective"] = {"minimise": "jerk", "total_time": "30 s"}
    elif what == 1:
        data["segments"] = {"1-2": {"duration": "4 s"}}
    elif what == 2:
        data.setdefault("nodes", {})["start"] = {"velocity": "1 deg/s"}
    else:
        data.setdefault("nodes", {}).setdefault("at", {})["2"] = {"time": "9 s"}


def draw_problem(draft) -> None:
    """A problem along curves in a draft."""
    rng = draft.rng
    curves = draw_curves(rng, draft.small)
    draft.data["route"] = {"bezier": [write_curve(rng, curve) for curve in curves]}
    if rng.random() < 0.3:
        kind = int(rng.integers(3))
        draft.data["body"] = settings.body(rng, wheels=kind > 0, spin=kind == 2)
    draft.limit(by_axis=0.3)
    if "body" in draft.data:
        draft.data["limits"]["torque"] = settings.bound(rng, 10 ** rng.uniform(-2, 2), "N*m", 0.4)
        if rng.random() < 0.5:
            draft.data["limits"]["momentum"] = settings.bound(
                rng, 1.0 + 10 ** rng.uniform(-1, 2), "N*m*s", 0.0
            )
    limit_origin(rng, draft.data["limits"], curves)
    if rng.random() < 0.05 and any(name in draft.data["limits"] for name in LINEAR_UNITS):
        draft.data["limits"] = {name: b for name, b in draft.data["limits"].items() if name in LINEAR_UNITS}
    draft.data["easing"] = choose_easing(rng, draft.r, curves, draft.small)
    if draft.r != 2 or rng.random() < 0.3:
        draft.node("continuity", draft.r)
    _add_rules(draft, len(curves))
    if rng.random() < 0.05:
        ask_too_much(rng, draft.data)
    draft.data["baselines"] = ["quintic"]


def _add_rules(draft, count: int) -> None:
    """Dwells, stops, slower curves."""
    rng = draft.rng
    if rng.random() < 0.15:
        draft.node("dwell", "0.5 s")
    for k in range(2, count + 1):
        roll = rng.random()
        if roll < 0.15:
            draft.rule(str(k), {"dwell": str(rng.choice(["2 s", "1e-3 s", "0 s"]))})
        elif roll < 0.3:
            draft.rule(str(k), {"stop": True})
    if rng.random() < 0.25:
        name = str(
            rng.choice([n for n in draft.data["limits"] if n not in ("torque", "momentum")] or ["velocity"])
        )
        units = settings.RATE_UNITS
        k = int(rng.integers(1, count + 1))
        unit_of = units.get(name, "m/s" + ("^2" if name == "linear_acceleration" else ""))
        draft.data["segments"] = {
            f"{k}-{k + 1}": {"limits": {name: settings.quantity(rng, 10 ** rng.uniform(-2, 1), unit_of)}}
        }
