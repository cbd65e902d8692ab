"""The pieces of many great-circle arcs as one stack, for values at many instants."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from timelaw.motion.arc import Arc
from timelaw.numerics.array import Array
from timelaw.numerics.chebyshev import ChebyshevStack, Index, Points, Rows, take_rows
from timelaw.numerics.quaternion import multiply, normalise
from timelaw.numerics.state_form import derive

Group = tuple[Index, Array, Array, Array]


@dataclass(frozen=True)
class ArcStack:
    """q = cos(φ/2) q_i + sin(φ/2) q_i ⊗ (0, n): `turns` (2, 4, N) are both quaternions, `axes` (3, N) are n.

    `groups` are the pieces of one shape: their places, durations (g,), states (g, c+1), controls (g, m+1).
    """

    turns: Array
    axes: Array
    groups: Sequence[Group]
    _known: dict[int, ChebyshevStack] = field(default_factory=dict, init=False, repr=False, compare=False)

    @classmethod
    def stack(cls, arcs: Sequence[Arc]) -> "ArcStack":
        """The pieces of all, one after another."""
        pieces = [piece for arc in arcs for piece in arc.profile.pieces]
        counts = [len(arc.profile.pieces) for arc in arcs]
        starts = np.repeat(normalise([arc.start for arc in arcs]), counts, axis=0)
        axes = np.repeat(normalise([arc.axis for arc in arcs]), counts, axis=0)
        alike: dict[tuple[int, int], list[int]] = defaultdict(list)
        for number, piece in enumerate(pieces):
            alike[len(piece.state), len(piece.control)].append(number)
        groups = []
        for numbers in alike.values():
            own = [pieces[k] for k in numbers]
            durations = np.array([piece.duration for piece in own])
            states, controls = (np.stack([getattr(p, name) for p in own]) for name in ("state", "control"))
            groups.append((np.array(numbers), durations, states, controls))
        across = multiply(starts, np.concatenate([np.zeros((len(axes), 1)), axes], axis=1))
        return cls(np.stack([starts.T, across.T]), axes.T.copy(), groups)

    @cached_property
    def durations(self) -> Array:
        """How long the pieces last (N,) [s]."""
        numbers = np.concatenate([group[0] for group in self.groups])
        return np.concatenate([group[1] for group in self.groups])[np.argsort(numbers)]

    def fill(self, rows: Rows, points: Points, values: Mapping[int, Array]) -> None:
        """Write q (m, 4) and rates (m, 3), by order, at points of one row, or of the row of each."""
        for order, value in values.items():
            angle = self._angle(order)(rows, points)
            if order:
                for k, axis in enumerate(self.axes):
                    np.multiply(angle, take_rows(axis, rows), out=value[:, k])
                continue
            # by the tangent of φ/4: NumPy is six times as fast with it as with cosine and sine
            angle /= 4
            sine = np.tan(angle, out=angle)
            cosine = sine * sine
            cosine += 1
            np.divide(2, cosine, out=cosine)
            sine *= cosine
            cosine -= 1
            part, rest = np.empty_like(sine), np.empty_like(sine)
            for k, (along, across) in enumerate(zip(*self.turns, strict=True)):
                np.multiply(cosine, take_rows(along, rows), out=part)
                np.multiply(sine, take_rows(across, rows), out=rest)
                np.add(part, rest, out=value[:, k])

    def _angle(self, order: int) -> ChebyshevStack:
        """The k-th time derivative of φ."""
        if order not in self._known:
            controls = [(numbers, derive(h, states, c, order)[0]) for numbers, h, states, c in self.groups]
            self._known[order] = ChebyshevStack.join(controls)
        return self._known[order]
