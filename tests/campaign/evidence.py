"""What a designed law is looked at by: the problem as the judge read it, the tour's legs, and dense samples."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from tests.campaign.legs import Leg, lay
from tests.campaign.spec import RATES, Spec

NODES, WEIGHTS = np.polynomial.legendre.leggauss(32)  # a curve bends too fast for 16
CHEBYSHEV = (1 - np.cos(np.linspace(0, np.pi, 25))) / 2
HIGHEST = 4
CLEAR = 16  # rounding errors of a time, by which samples keep clear of breaks


@dataclass(frozen=True)
class Piece:
    """Between two breaks of the law: its segment, first and last instant."""

    segment: int
    start: float
    end: float


@dataclass(frozen=True)
class Evidence:
    """A design beside its problem."""

    spec: Spec
    design: Any

    @property
    def law(self):
        return self.design.optimised.law

    @cached_property
    def labels(self) -> list[str]:
        """Of the visits, dwells counted once."""
        legs = [s for s in self.law.segments if s.moves]
        return [legs[0].origin, *(s.target for s in legs)]

    @cached_property
    def points(self) -> dict[str, np.ndarray]:
        """Orientations by label: of the file, or where that names a lattice, the program's."""
        if self.spec.points:
            return self.spec.points
        found = self.design.orientations
        return dict(zip(found.labels, found.quaternions, strict=True))

    @cached_property
    def legs(self) -> list[Leg]:
        """The legs."""
        return lay(self.spec, self.labels, self.points)

    @cached_property
    def visits(self) -> list[tuple[float, float]]:
        """Arrival and departure [s] at each visit."""
        found, segments = [], list(self.law.segments)
        times = [float(t) for t in self.law.times]
        arrived = 0.0
        for k, segment in enumerate(segments):
            if segment.moves:
                found.append((arrived, times[k]))
                arrived = times[k + 1]
        return [*found, (arrived, times[-1])]

    @cached_property
    def pieces(self) -> list[Piece]:
        """The law from break to break."""
        found = []
        for k, segment in enumerate(self.law.segments):
            t = self.law.times[k] + np.asarray(segment.breaks) * (self.law.times[k + 1] - self.law.times[k])
            t[-1] = self.law.times[k + 1]
            found += [Piece(k, float(a), float(b)) for a, b in pairwise(t) if b > a]
        return found

    def inside(self, piece: Piece, places: np.ndarray) -> np.ndarray:
        """Instants at the parts `places` of a piece, the ends kept clear of what is beyond them."""
        long = piece.end - piece.start
        edge = min(max(CLEAR * np.spacing(piece.end), CLEAR * np.finfo(float).eps * long), long / 4)
        return np.clip(piece.start + long * places, piece.start + edge, piece.end - edge)

    @cached_property
    def samples(self) -> list[dict[int, np.ndarray]]:
        """Per piece, q and its rates at Chebyshev's points."""
        return self.sampled(CHEBYSHEV)

    def sampled(self, places: np.ndarray) -> list[dict[int, np.ndarray]]:
        """Per piece, q and its rates at these parts of it."""
        t = np.array([self.inside(piece, places) for piece in self.pieces])
        values = {k: np.asarray(self.law(t, k)) for k in range(HIGHEST + 1)}
        return [{k: value[i] for k, value in values.items()} for i in range(len(self.pieces))]

    @cached_property
    def largest(self) -> dict[int, float]:
        """The largest |rate| of the motion, by order."""
        return {
            k: max(float(np.max(np.linalg.norm(s[k], axis=1))) for s in self.samples) for k in range(1, 5)
        }

    @cached_property
    def scale(self) -> dict[int, float]:
        """What a jump of each rate is a part of: the limit of that order, else the largest of the motion.

        At least the speed over the power of the whole time: in a steady turn all else is rounding.
        """
        given = {
            RATES[name]: float(np.min(bound)) for name, bound in self.spec.limits.items() if name in RATES
        }
        steady = {k: self.largest[1] / self.law.duration ** (k - 1) for k in range(1, 5)}
        return {k: given.get(k, max(self.largest[k], steady[k])) for k in range(1, 5)}

    def resolution(self, piece: Piece, order: int) -> float:
        """What of the k-th rate rounding may hide: of times, and of what is integrated on a short piece."""
        eps, long = np.finfo(float).eps, piece.end - piece.start
        angle = 2 * np.pi
        return 64 * eps * angle / min(long, 1e300) ** order + 1e-12 * self.largest[order]

    @cached_property
    def jumps(self) -> list[tuple[float, int, str]]:
        """(part of the scale, order, place) of every jump up to the continuity asked for."""
        orders = range(1, self.spec.continuity + 1)
        found = [jump for order in orders for jump in self._node_jumps(order)]
        for segment, edges in zip(self.law.segments, self.law.edges, strict=True):
            for k in orders:
                for place, jump in zip(segment.breaks[1:], edges.jumps[k - 1], strict=False):
                    at = f"inside {segment.name} at {place:.9g} of it"
                    found.append((float(np.linalg.norm(jump)) / (self.scale[k] or 1.0), k, at))
        return found

    def _node_jumps(self, order: int) -> list[tuple[float, int, str]]:
        """Of one rate, what is outside the motion included."""
        law, legs = self.law, [s for s in self.law.segments if s.moves]
        left, right = (np.array(law(law.times, order, side)) for side in ("left", "right"))
        left[0] = self.spec.end_rates("start")[order - 1] * self._axis(legs[0], 0)
        right[-1] = self.spec.end_rates("end")[order - 1] * self._axis(legs[-1], -1)
        sizes = np.linalg.norm(right - left, axis=1) / (self.scale[order] or 1.0)
        return [(float(size), order, f"at t = {t:.9g}") for t, size in zip(law.times, sizes, strict=True)]

    def _axis(self, segment, end: int) -> np.ndarray:
        """About which rates at an end are given: the leg's."""
        axis = segment.axis_at(end)
        return self.legs[end].axis if axis is None else np.asarray(axis)

    @cached_property
    def beyond(self) -> float:
        """The largest part of a leg by which the body leaves its arc and comes back; no law is wrong for it."""
        if self.spec.through:
            return 0.0
        turned, worst = 0.0, 0.0
        legs = iter(self.legs)
        moving = [s.moves for s in self.law.segments]
        for k, (piece, sample) in enumerate(zip(self.pieces, self.samples, strict=True)):
            if not moving[piece.segment]:
                continue
            if k == 0 or self.pieces[k - 1].segment != piece.segment:
                turned, leg = 0.0, next(legs)
            speed = sample[1] @ np.asarray(self.law.segments[piece.segment].axis_at(0))
            shape = np.polynomial.Chebyshev.fit(
                CHEBYSHEV, speed * (piece.end - piece.start), len(CHEBYSHEV) - 1
            )
            places = turned + shape.integ(lbnd=0)(CHEBYSHEV)
            worst = max(worst, float(np.max(places)) / leg.angle - 1, -float(np.min(places)) / leg.angle)
            turned = float(places[-1])
        return worst
