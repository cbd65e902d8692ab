"""Laws that say more of their path, each designed once: near their arcs, round and round, along Bézier curves.

Their limits are hardly above what is reached, those of single segments too.
"""

import copy
import json
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

from tests.exact.curve_laws import ABOVE, make_rest, piece
from tests.exact.documents import ONE, document, dwell, rational
from tests.exact.handmade import follow
from timelaw.certificate import certify
from timelaw.export import format_law
from timelaw.law_file import from_document
from timelaw.pipeline import design_layout, lay_out_problem
from timelaw.pipeline_bezier import design_curves
from timelaw.problem.load import check_problem
from timelaw.problem.source import read

Document = dict[str, Any]

RATES = "velocity: 60 deg/s, acceleration: 120 deg/s^2"
JERK = "jerk: 600 deg/s^3"
LINEAR = "linear_velocity: 0.5 m/s, linear_acceleration: [1 m/s^2, 1.5 m/s^2, 2 m/s^2]"
LINE = "{quaternions: [[1, 0, 0, 0], [0.8, 0.6, 0, 0]], points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}"
BEND = (
    "{quaternions: [[0.8, 0.6, 0, 0], [0.8, 0.36, 0.48, 0], [0.48, 0.64, 0, 0.6]], weights: [1, 0.9, 1], "
    "points: [[1 m, 0 m, 0 m], [2 m, 1 m, 0 m], [1 m, 1 m, 1 m]], translation: plain}"
)
CURVE = [[1.0, 0.0, 0.0, 0.0], [0.8, 0.6, 0.0, 0.0], [0.48, 0.64, 0.6, 0.0]]
PLACES = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5]]
INERTIA = "[12 kg*m^2, 10 kg*m^2, 8 kg*m^2]"


def _through(places: str, *lines: str) -> str:
    orientations = f"orientations: {{list: {places}, as: euler, sequence: XYZ, unit: deg}}, tour: given"
    closed = ", closed: true" if "periodic" in "".join(lines) else ""
    return "\n".join(["timelaw: 1", "name: path", f"route: {{{orientations}{closed}}}", *lines])


def _curves(given: list[str], limits: str, *lines: str) -> str:
    route = f"route: {{bezier: [{', '.join(given)}]}}"
    return "\n".join(["timelaw: 1", "name: path", route, f"limits: {{{limits}}}", "baselines: []", *lines])


def _halve(points: list[list[float]]) -> list[list[list[float]]]:
    """Both halves of a curve, by de Casteljau."""
    left, right = [points[0]], [points[-1]]
    while len(points) > 1:
        points = [[(x + y) / 2 for x, y in zip(a, b, strict=True)] for a, b in pairwise(points)]
        left.append(points[0])
        right.insert(0, points[-1])
    return [left, right]


def _write(control: list[list[float]], places: list[list[float]]) -> str:
    """A curve of a problem file, its control quaternions of any length."""
    sizes = [sum(x * x for x in point) ** 0.5 for point in control]
    quaternions = [[x / size for x in point] for point, size in zip(control, sizes, strict=True)]
    rows = ", ".join(f"[{', '.join(f'{x!r} m' for x in row)}]" for row in places)
    return f"{{quaternions: {quaternions}, weights: {sizes}, translation: plain, points: [{rows}]}}"


EASING = "easing: {basis: polynomial, degree: 5}"
JOINED = [_write(*parts) for parts in zip(_halve(CURVE), _halve(PLACES), strict=True)]
PATHS = {
    "near the arcs": _through(
        "[[0, 0, 0], [40, 0, 0], [40, 50, 0]]", f"limits: {{{RATES}, {JERK}}}",
        "motion: {kind: through, degree: 5, pieces: 1, deviation: 4 deg}",
    ),
    "round": _through(
        "[[0, 0, 0], [50, 0, 0], [0, 60, 10]]", f"limits: {{{RATES}, {JERK}}}",
        "motion: {kind: through, degree: 5, pieces: 1}", "nodes: {start: periodic}",
    ),
    "round near the arcs": _through(
        "[[0, 0, 0], [50, 0, 0], [0, 60, 10]]", f"limits: {{velocity: 60 deg/s, {JERK}, torque: 20 N*m}}",
        f"body: {{inertia: {INERTIA}}}", "nodes: {start: periodic}",
        "motion: {kind: through, degree: 6, pieces: 1, deviation: 10 deg}",
    ),
    "curves and a dwell": _curves([LINE, BEND], f"{RATES}, {LINEAR}", EASING, "nodes: {at: {2: {dwell: 0.5 s}}}"),
    "a curve in pieces": _curves(
        [BEND], f"velocity: 60 deg/s, {JERK}", "easing: {basis: spline, degree: 3, intervals: 5}",
        "segments: {1-2: {limits: {linear_velocity: [1 m/s, 1 m/s, 1 m/s], linear_acceleration: 1 m/s^2}}}",
    ),
    "a joint that is passed": _curves(JOINED, f"{RATES}, linear_velocity: 0.5 m/s", EASING),
}  # fmt: skip


def _design(text: str) -> Document:
    """The law of a problem text, with its record."""
    source = read(text, "path.yaml")
    problem, path = check_problem(source), Path("path.yaml")
    if problem.route.bezier:
        done = design_curves(path, problem, source).optimised
    else:
        done = design_layout(lay_out_problem(path, problem, source, None), None).optimised
    return json.loads(format_law(done.law, done.certificate, {}))


def make_travel(limits: Document | None = None, together: int = 3, **others: Any) -> Document:
    """There, a rest, and back: handmade, its origin moves from rest to rest along a line that bends."""
    first, last, place, there = ONE, [0.8, 0.36, 0.48, 0.0], [1.0, -2.0, 0.5], [2.0, 1.0, 0.0]
    go, back = (make_rest(a, b, together, 4.0) for a, b in ((first, last), (last, first)))
    middle = [1.2, 0.0, 3.0]
    go["points"] = [place] * together + [middle] + [there] * together
    back["points"] = go["points"][::-1]
    rest = dwell("2", 1.0, start_time=0.0, orientation=last) | {"point": there}
    segments = follow(rational("1", "2", [go]), rest, rational("2", "3", [back]))
    segments = json.loads(json.dumps(segments))  # each number by itself, to be altered
    given = limits or {"velocity": 2.0, "jerk": 40.0, "linear_velocity": 5.0, "linear_acceleration": 20.0}
    return document(segments, given, **{"continuity": 2, **others})


def halve_travel(law: Document, index: int = 0) -> Document:
    """The same law, one of its segments in two pieces."""
    law = copy.deepcopy(law)
    (whole,) = law["segments"][index]["pieces"]
    parts = [_halve(whole[key]) for key in ("control", "points")]
    time = whole["duration"] / 2
    law["segments"][index]["pieces"] = [piece(time, c) | {"points": p} for c, p in zip(*parts, strict=True)]
    return law


def touch_all(law: Document) -> Document:
    """The same law with limits as low as can be, those of single segments too, and with its record."""
    law = copy.deepcopy(law)
    reached = {(peak.index, peak.label): peak.upper * ABOVE for peak in certify(from_document(law)).peaks}
    everywhere: dict[str, float] = {}
    for (_, label), upper in reached.items():
        everywhere[label] = max(everywhere.get(label, 0.0), upper)
    _lower(law["limits"], everywhere, "")
    for index, segment in enumerate(law["segments"]):
        own = {label: upper for (where, label), upper in reached.items() if where == index}
        name = f"{segment.get('from')}–{segment.get('to')}"
        _lower(segment.get("limits", {}), own, f" on {name}")
    read_back = from_document(law)
    return json.loads(format_law(read_back, certify(read_back), {}))


def _lower(limits: Document, reached: dict[str, float], place: str) -> None:
    for name, bounds in limits.items():
        here = "" if name == "deviation" else place
        if isinstance(bounds, list):
            limits[name] = [max(reached[f"{name} {axis}{here}"], 1e-9) for axis in "xyz"]
        else:
            limits[name] = reached[f"{name}{here}"]


@cache
def list_path_laws() -> dict[str, Document]:
    """All of them, by name."""
    made = {name: touch_all(_design(text)) for name, text in PATHS.items()}
    there_and_back = touch_all(make_travel())
    return {**made, "there and back": there_and_back, "in two pieces": touch_all(halve_travel(make_travel()))}
