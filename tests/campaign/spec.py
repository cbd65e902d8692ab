"""A problem file as the judge reads it: SI numbers and orientations, without the program's own reader."""

import re
from dataclasses import dataclass, field
from io import StringIO

import numpy as np
from ruamel.yaml import YAML
from scipy.spatial.transform import Rotation

from tests.campaign.attitude import unit

DEGREE = np.pi / 180
UNITS = {"deg": DEGREE, "rad": 1.0, "s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0, "": 1.0}
UNITS |= {f"{a}/s{p}": UNITS[a] for a in ("deg", "rad") for p in ("", "^2", "^3", "^4")}
UNITS |= {f"{a}{p}": size for a, size in (("m", 1.0), ("mm", 1e-3)) for p in ("", "/s", "/s^2")}
UNITS |= {"N*m": 1.0, "mN*m": 1e-3, "N*m*s": 1.0, "kg*m^2": 1.0}
QUANTITY = re.compile(r"([-+0-9.eE]+)\s*(.*)$")
RATES = {"velocity": 1, "acceleration": 2, "jerk": 3, "snap": 4}
SEARCHED = ("shortest", "fewest-stops", "least-turning", "fastest", "paper")
EXACT = 4e-16  # of the norm: quaternions written to the last digit


def number(value) -> float:
    """A quantity in SI; zero may stand without its unit."""
    if isinstance(value, int | float):
        return float(value)
    size, name = QUANTITY.match(value).groups()
    return float(size) * UNITS[name.strip()]


def numbers(value):
    """One number, or three as an array."""
    return np.array([number(v) for v in value]) if isinstance(value, list) else number(value)


@dataclass(frozen=True)
class Body:
    """Inertia (3, 3), whether wheels turn it, and the total momentum (3,) in body axes at t = 0."""

    inertia: np.ndarray
    wheels: bool
    momentum: np.ndarray


@dataclass(frozen=True)
class Spec:
    """A problem; `points` by label, none where a lattice gives them; `precision` [rad] of what is typed."""

    data: dict
    text: str
    points: dict[str, np.ndarray]
    precision: float
    limits: dict
    body: Body | None
    continuity: int
    nodes: dict = field(default_factory=dict)
    legs: dict = field(default_factory=dict)

    @property
    def tour(self):
        """A name or a list of labels."""
        tour = self.data["route"].get("tour", "given")
        return [str(label) for label in tour] if isinstance(tour, list) else tour

    @property
    def searched(self) -> bool:
        """Whether the program chooses the order."""
        return self.tour in SEARCHED

    @property
    def through(self) -> bool:
        """Whether the nodes are passed without a stop."""
        motion = self.data.get("motion", "arcs")
        return (motion["kind"] if isinstance(motion, dict) else motion) == "through"

    @property
    def curved(self) -> bool:
        """Whether the route is one of Bézier curves."""
        return "bezier" in self.data["route"]

    @property
    def closed(self) -> bool:
        """Whether the body returns."""
        return bool(self.data["route"].get("closed", False))

    @property
    def easing(self) -> dict:
        """As written; the basis is always there."""
        return {"basis": "polynomial", **self.data.get("easing", {})}

    @property
    def degree(self) -> int:
        """Of the easing, the documented default where it is left open."""
        r = self.continuity
        default = max(9, 2 * r + 3) if self.easing["basis"] == "polynomial" else max(3, r + 1 + (r > 2))
        return self.easing.get("degree", default)

    @property
    def intervals(self) -> int:
        """Of a spline."""
        return self.easing.get("intervals", 50)

    @property
    def objective(self) -> dict:
        """What is made least, as written."""
        goal = self.data.get("objective", "time")
        return {"minimise": "time"} if goal == "time" else goal

    @property
    def total_time(self) -> float | None:
        """In s, if it is given so."""
        given = self.objective.get("total_time")
        return None if given is None or str(given).endswith("minimum") else number(given)

    @property
    def stretch(self) -> float | None:
        """Of the least time, if the total is given so."""
        given = str(self.objective.get("total_time", ""))
        return float(given.removesuffix(" x minimum")) if given.endswith("minimum") else None

    def end_rates(self, which: str) -> list[float]:
        """φ', φ'', … (r) where the motion begins (`start`) or ends."""
        given = (self.data.get("nodes") or {}).get(which) or {}
        rates = [number(given.get(key, 0.0)) for key in ("velocity", "acceleration", "jerk")]
        return [*rates, 0.0][: self.continuity]

    @property
    def moving(self) -> bool:
        """Whether it begins or ends at speed."""
        return any(self.end_rates("start")) or any(self.end_rates("end"))

    @property
    def timed(self) -> bool:
        """Whether any time is given."""
        return (
            any("time" in rule for rule in self.nodes.values())
            or any("duration" in rule for rule in self.legs.values())
            or "total_time" in self.objective
        )

    def dwell(self, label: str, place: int, count: int) -> float:
        """Rest [s] on the visit of that number of `count`."""
        rule = self.nodes.get(label, {})
        last = place == count - 1
        if "dwell" in rule and not (self.closed and last):
            return number(rule["dwell"])
        nodes = self.data.get("nodes") or {}
        moving = (place == 0 and "start" in nodes) or (last and "end" in nodes)
        return 0.0 if moving or (self.closed and last) else number(nodes.get("dwell", 0.0))


def read_spec(text: str) -> Spec:
    """Read a problem text."""
    data = YAML(typ="safe", pure=True).load(StringIO(text))
    points, precision = _points(data["route"].get("orientations", {}))
    nodes = data.get("nodes") or {}
    return Spec(
        data,
        text,
        points,
        precision,
        _limits(data["limits"]),
        _body(data.get("body")),
        nodes.get("continuity", 2),
        {str(label): rule for label, rule in (nodes.get("at") or {}).items()},
        {str(name): rule for name, rule in (data.get("segments") or {}).items()},
    )


def _limits(given) -> dict:
    return {name: numbers(value) for name, value in (given or {}).items()}


def leg_limits(spec: Spec, origin: str, target: str, places: tuple[bool, bool] = (True, True)) -> list[dict]:
    """All sets of limits that hold on a leg; `places` say whether the rules of its two ends count."""
    rules = [spec.legs.get(f"{origin}-{target}", {})]
    rules += [
        spec.nodes.get(label, {}) for label, counts in zip((origin, target), places, strict=True) if counts
    ]
    return [spec.limits, *(_limits(rule["limits"]) for rule in rules if rule.get("limits"))]


def _body(given) -> Body | None:
    if not given:
        return None
    rows = given["inertia"]
    matrix = np.array([numbers(row) for row in rows]) if isinstance(rows[0], list) else np.diag(numbers(rows))
    momentum = numbers(given.get("momentum", [0.0, 0.0, 0.0]))
    return Body(matrix, given.get("actuator", "external") == "wheels", momentum)


def _points(spec) -> tuple[dict[str, np.ndarray], float]:
    if "list" not in spec:
        return {}, 0.0
    rows = np.array(spec["list"], dtype=float)
    form = spec.get("as", "wxyz")
    factor = DEGREE if spec.get("unit") == "deg" else 1.0
    if form == "rotation-vector":
        found = Rotation.from_rotvec(rows * factor).as_quat(scalar_first=True)
    elif form == "euler":
        found = Rotation.from_euler(spec["sequence"], rows * factor).as_quat(scalar_first=True)
    else:
        found = rows[:, [3, 0, 1, 2]] if form == "xyzw" else rows
    precise = form in ("rotation-vector", "euler")
    labels = [str(k + 1) for k in range(len(rows))]
    return dict(zip(labels, unit(found), strict=True)), 0.0 if precise else _precision(rows)


def _precision(rows: np.ndarray) -> float:
    """Body angle [rad] by which typed quaternions may be off: 2 |δq|, δq half a unit of each last digit."""
    if np.all(np.abs(np.linalg.norm(rows, axis=1) - 1) <= EXACT):
        return 0.0
    if np.array_equal(rows, rows.astype(np.float32).astype(float)):
        return 4 * 2.0**-25
    digits = max(len(np.format_float_positional(abs(v)).partition(".")[2]) for v in rows.ravel())
    return 2 * 10.0**-digits
