"""Profiles: a function of time in pieces that store where they start and how their highest rate runs.

A piece lasts h; it holds φ and its first c derivatives at its start, and the Bernstein control points of the
(c+1)-th over [0, h]. All else follows by integration, φ^(k)(t) = φ^(k)(0) + ∫ φ^(k+1), which loses no digits
however short the piece: to difference control points of φ loses ε/h³ of the third derivative.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial
from timelaw.numerics.state_form import derive

Side = Literal["left", "right"]


@dataclass(frozen=True)
class Piece:
    """`duration` h, `state` (c+1,) (φ, φ', …, φ^(c)) at the start, `control` (m+1,) of φ^(c+1)."""

    duration: float
    state: Array
    control: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "state", freeze(self.state))
        object.__setattr__(self, "control", freeze(self.control))

    def scaled(self, size: float, duration: float) -> "Piece":
        """Of a function `size` times as large, `duration` times as slow."""
        powers = duration ** np.arange(len(self.state) + 1.0)
        control = self.control * size / powers[-1]
        return Piece(self.duration * duration, self.state * size / powers[:-1], control)


class _Group(NamedTuple):
    """Pieces of one shape, stacked: their places, and durations (g,), states (g, c+1), controls (g, m+1)."""

    places: NDArray[np.int64]
    durations: Array
    states: Array
    controls: Array


@dataclass(frozen=True)
class Profile:
    """Pieces that follow each other. An easing is a profile from 0 to 1 in the time 1.

    τ ∈ [0, 1] is the part of the profile's own duration that has passed.
    """

    pieces: tuple[Piece, ...]
    _known: dict[int, list[Polynomial]] = field(default_factory=dict, init=False, repr=False, compare=False)

    @cached_property
    def times(self) -> Array:
        """Where the pieces meet (p+1,), from 0 on."""
        return freeze(np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])]))

    @property
    def duration(self) -> float:
        """How long it lasts."""
        return float(self.times[-1])

    @cached_property
    def breaks(self) -> Array:
        """Where the pieces meet (p+1,), in τ."""
        breaks = self.times / self.duration
        breaks[-1] = 1.0
        return freeze(breaks)

    @cached_property
    def _groups(self) -> list[_Group]:
        shapes: dict[tuple[int, int], list[int]] = defaultdict(list)
        for index, piece in enumerate(self.pieces):
            shapes[len(piece.state), len(piece.control)].append(index)
        return [
            _Group(
                np.array(places),
                np.array([self.pieces[i].duration for i in places]),
                np.stack([self.pieces[i].state for i in places]),
                np.stack([self.pieces[i].control for i in places]),
            )
            for places in shapes.values()
        ]

    def key(self) -> tuple[bytes, ...]:
        """Equal for profiles that are equal in every piece."""
        return tuple(
            array.tobytes()
            for piece in self.pieces
            for array in (np.array([piece.duration]), piece.state, piece.control)
        )

    def derivative(self, order: int) -> list[Polynomial]:
        """The polynomials d^k φ/dt^k on the pieces, each over [0, 1], with their rounding."""
        if order not in self._known:
            found: dict[int, Polynomial] = {}
            for group in self._groups:
                control, error = derive(group.durations, group.states, group.controls, order)
                found.update(
                    zip(group.places.tolist(), map(Polynomial, control, error.tolist()), strict=True)
                )
            self._known[order] = [found[i] for i in range(len(self.pieces))]
        return self._known[order]

    def __call__(self, tau: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """d^k φ/dt^k at τ (...), from the given side of a break; returns (...).

        Raises:
            ValueError: τ outside [0, 1].
        """
        tau = np.asarray(tau, dtype=float)
        at, u = self.find_pieces(tau, side)
        rates, value = self.derivative(order), np.empty(tau.shape)
        for group in self._groups:
            row = np.full(len(self.pieces), -1)
            row[group.places] = np.arange(len(group.places))
            here = row[at] >= 0
            control = np.stack([rates[i].control for i in group.places])
            value[here] = evaluate(control[row[at[here]]], u[here])
        return value

    def find_pieces(self, tau: Array, side: Side) -> tuple[NDArray[np.int64], Array]:
        """Which piece each τ (...) is in, and the part of it that has passed (...).

        Raises:
            ValueError: τ outside [0, 1].
        """
        if np.any(~((tau >= 0) & (tau <= 1))):
            raise ValueError("τ outside [0, 1]")
        at = locate(self.breaks, tau, side)
        # a piece may be shorter than times are told apart: its ends are known by their breaks
        durations = np.array([piece.duration for piece in self.pieces])
        u = np.clip((tau * self.duration - self.times[at]) / durations[at], 0.0, 1.0)
        return at, np.where(tau <= self.breaks[at], 0.0, np.where(tau >= self.breaks[at + 1], 1.0, u))

    def end(self, order: int) -> float:
        """d^k φ/dt^k at the last instant."""
        return float(self.derivative(order)[-1].control[-1])

    def scaled(self, size: float, duration: float) -> "Profile":
        """`size` times as large, `duration` times as slow."""
        return Profile(tuple(piece.scaled(size, duration) for piece in self.pieces))

    @classmethod
    def single(cls, control: ArrayLike, order: int = 2) -> "Profile":
        """One polynomial φ over the time 1, from its control points; `order` derivatives as its state."""
        return cls.from_control_points(np.array([0.0, 1.0]), [np.asarray(control, dtype=float)], order)

    @classmethod
    def from_control_points(
        cls, breaks: ArrayLike, controls: Sequence[ArrayLike], order: int = 2
    ) -> "Profile":
        """Each piece from the control points of φ itself between two breaks; nothing is joined."""
        pieces = []
        for width, control in zip(np.diff(np.asarray(breaks, dtype=float)).tolist(), controls, strict=True):
            rates = [differentiate(np.asarray(control, dtype=float), k) / width**k for k in range(order + 2)]
            pieces.append(Piece(width, np.array([rate[0] for rate in rates[:-1]]), rates[-1]))
        return cls(tuple(pieces))


def locate(times: Array, t: Array, side: Side) -> NDArray[np.int64]:
    """Index of the interval of `times` (n+1,) that holds each t, from the given side of a node.

    Raises:
        ValueError: t outside [times[0], times[-1]].
    """
    if np.any(~((t >= times[0]) & (t <= times[-1]))):
        raise ValueError(f"time outside [{times[0]:g}, {times[-1]:.17g}] s")
    return np.clip(np.searchsorted(times, t, side=side) - 1, 0, len(times) - 2)
