"""Does the body follow its curves? Every orientation and place of a law is looked for on them, in order."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from tests.campaign.curve_motion import sample_piece
from tests.campaign.curve_spec import Bezier

FOLLOWS = 1e-7  # rad, and of the farthest place
PLACES, GRID = (
    24,
    1601,
)  # of a leg, at which the curve is looked for; of the curve, where it is looked for first
BACKWARD = 1e-6  # of u; by which a place may be found before the last one
LOWS, STEPS = 6, 12  # nearest places of the grid that are tried; of Newton from each


def path_is_followed(e: Any) -> Iterator[str]:
    """Every orientation and place is one of the curve, in its order, from its first to its last."""
    for k, (segment, curve) in enumerate(zip(e.legs, e.curves, strict=True)):
        yield from (f"path: curve {k + 1}: {what}" for what in _follow(e.document, segment, curve))


class _Way:
    """A curve as vectors (7,): the quaternion twice, for angles of the body, and the place over its size."""

    def __init__(self, curve: Bezier):
        self.curve = curve
        self.grid = np.linspace(0, 1, GRID)
        self.size = max(float(np.max(np.abs(curve.place(self.grid)))), 1e-300)
        self.known = self.at(self.grid)

    def at(self, u: np.ndarray) -> np.ndarray:
        q = self.curve.orient(u)
        return self.join(q / np.linalg.norm(q, axis=1, keepdims=True), self.curve.place(u))

    def join(self, q: np.ndarray, place: np.ndarray) -> np.ndarray:
        return np.hstack([2 * q, place / self.size])

    def find(self, there: np.ndarray, last: float) -> tuple[float, float]:
        """(distance, u) of the first place from `last` on where the curve is, else of the nearest; -q is q."""
        signs = np.where(self.known[:, :4] @ there[:4] < 0, -1.0, 1.0)[:, None]
        off = np.linalg.norm(
            self.known - np.hstack([signs * there[:4], np.tile(there[4:], (GRID, 1))]), axis=1
        )
        first = max(int(np.searchsorted(self.grid, last)) - 2, 0)
        padded = np.concatenate([[np.inf], off[first:], [np.inf]])
        lows = first + np.nonzero((padded[1:-1] <= padded[:-2]) & (padded[1:-1] <= padded[2:]))[0]
        best = (np.inf, last)
        for i in sorted(sorted(lows, key=lambda i: off[i])[:LOWS]):
            best = min(best, self._descend(there, float(self.grid[i]), max(last - BACKWARD, 0.0)))
            if best[0] <= FOLLOWS:
                break
        return best

    def _descend(self, there: np.ndarray, u: float, least: float) -> tuple[float, float]:
        """By Newton's steps along the curve, halved where they lead no nearer; then by halving what is left."""
        best, step = (self.measure(there, max(u, least)), max(u, least)), 1.0 / GRID
        for _ in range(STEPS):
            slope = (self.at(np.array([best[1] + 1e-6])) - self.at(np.array([best[1] - 1e-6])))[0] / 2e-6
            off = self._off(there, best[1])
            move = -float(off @ slope) / max(float(slope @ slope), 1e-300)
            tried = [min(max(best[1] + move * part, least), 1.0) for part in (1.0, 0.5, 0.1)]
            new = min((self.measure(there, v), v) for v in tried)
            if new[0] >= best[0]:
                break
            best = new
        while step > 1e-13 and best[0] > FOLLOWS:
            near = [min(max(best[1] + way * step, least), 1.0) for way in (-1, 1)]
            best, step = min([best, *((self.measure(there, v), v) for v in near)]), step / 1.5
        return best

    def _off(self, there: np.ndarray, u: float) -> np.ndarray:
        here = self.at(np.array([u]))[0]
        sign = -1.0 if here[:4] @ there[:4] < 0 else 1.0
        return here - np.concatenate([sign * there[:4], there[4:]])

    def measure(self, there: np.ndarray, u: float) -> float:
        """The distance."""
        return float(np.linalg.norm(self._off(there, u)))


def _follow(document: dict, segment: int, curve: Bezier) -> Iterator[str]:
    leg, way = document["segments"][segment], _Way(curve)
    ends = np.cumsum([p["duration"] for p in leg["pieces"]])
    last = 0.0
    for t in np.linspace(0, ends[-1], PLACES):
        piece = min(int(np.searchsorted(ends, t)), len(ends) - 1)
        part = (t - (ends[piece - 1] if piece else 0.0)) / leg["pieces"][piece]["duration"]
        off, u = way.find(_look(document, segment, piece, min(max(part, 0.0), 1.0), way), last)
        if not off <= FOLLOWS:
            yield f"{off:.3g} beside the curve at {t:.6g} s, u = {u:.6g}"
            return
        last = u
    for u, piece in ((0.0, 0), (1.0, len(ends) - 1)):
        off = way.measure(_look(document, segment, piece, u, way), u)
        if not off <= FOLLOWS:
            yield f"{off:.3g} from its end at u = {u}"


def _look(document: dict, segment: int, piece: int, part: float, way: _Way) -> np.ndarray:
    one = sample_piece(document, segment, piece, np.array([part]))
    return way.join(one.q, one.places[0] if one.places else np.zeros((1, 3)))[0]
