"""Laws for the tests of what leaves the tool: shipped ones, small ones of every kind of segment, a quarter turn."""

from functools import cache
from pathlib import Path

import numpy as np

from timelaw.law_file import from_document, read_law

ROOT = Path(__file__).parent.parent
SMALL = ROOT / "tests" / "fuzz" / "corpus" / "law"
LAWS = {
    "paper": ROOT / "results" / "paper-24-cell" / "law.json",
    "through": ROOT / "results" / "paper-24-cell-through" / "law.json",
    "dwells": SMALL / "polynomial.json",
    "spline": SMALL / "spline.json",  # four pieces on a leg, with wheels
    "curves": SMALL / "curves.json",  # two pieces a leg, with wheels and a total momentum
    "mixed": SMALL / "arcs-and-curves.json",
    "points": SMALL / "points.json",  # with a translation
}
SHIPPED = ("paper", "through", "dwells")


@cache
def law_of(name):
    return read_law(LAWS[name])[0]


def quarter_turn(turn=np.pi / 2, duration=2.0, axis=(0.0, 0.0, 1.0), inertia=None):
    """From rest to rest by the quintic, about one axis."""
    jerk = turn / duration**3
    end = [float(np.cos(turn / 2)), *(np.sin(turn / 2) * np.array(axis)).tolist()]
    segment = {
        "kind": "arc", "from": "a", "to": "b", "start_time": 0.0, "duration": duration,
        "start": [1.0, 0.0, 0.0, 0.0], "end": end, "axis": list(axis), "angle": turn,
        "pieces": [{"duration": duration, "state": [0.0, 0.0, 0.0], "bernstein": [60 * jerk, -120 * jerk, 60 * jerk]}],
    }  # fmt: skip
    head = {
        "format": "timelaw-law", "version": 2, "name": "quarter", "duration": duration,
        "conventions": {"quaternion": "wxyz, Hamilton, active, body to world", "rates": "body axes", "units": "rad, s"},
        "limits": {"velocity": 10.0},
    }  # fmt: skip
    body = {} if inertia is None else {"body": {"inertia": inertia}}
    return from_document({**head, **body, "segments": [segment]})


def angles_between(p, q):
    """Rotation angles [rad] between orientations (m, 4), by the components."""
    p, q = (np.asarray(x) / np.linalg.norm(x, axis=-1, keepdims=True) for x in (p, q))
    near = np.minimum(np.linalg.norm(p - q, axis=-1), np.linalg.norm(p + q, axis=-1))
    return 4 * np.arcsin(np.minimum(near / 2, 1.0))
