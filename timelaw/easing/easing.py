"""An easing as data: Bernstein control points on the intervals between breaks."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from timelaw.numerics.array import Array, freeze
from timelaw.numerics.bernstein import bound_rounding, differentiate, evaluate
from timelaw.numerics.polynomial import Polynomial

Side = Literal["left", "right"]


@dataclass(frozen=True)
class Easing:
    """s = f(τ): on [breaks[i], breaks[i+1]] the polynomial with control points `pieces[i]`.

    `breaks` (p+1,) ascend from 0 to 1; the pieces may differ in degree. Both are copied, and read-only.
    """

    breaks: Array
    pieces: tuple[Array, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "breaks", freeze(self.breaks))
        object.__setattr__(self, "pieces", tuple(freeze(piece) for piece in self.pieces))

    def key(self) -> tuple[bytes, ...]:
        """Equal for easings that are equal in every break and piece."""
        return tuple(array.tobytes() for array in (self.breaks, *self.pieces))

    @classmethod
    def single(cls, control: ArrayLike) -> "Easing":
        """One polynomial over the whole leg."""
        return cls(np.array([0.0, 1.0]), (np.array(control, dtype=float),))

    def __call__(self, tau: ArrayLike, order: int = 0, side: Side = "right") -> Array:
        """d^k f/dτ^k at τ (...), from the given side of a break; returns (...).

        Raises:
            ValueError: τ outside [0, 1].
        """
        tau = np.asarray(tau, dtype=float)
        if np.any((tau < 0) | (tau > 1)):
            raise ValueError("τ outside [0, 1]")
        at = np.searchsorted(self.breaks, tau, side=side) - 1
        at = np.clip(at, 0, len(self.pieces) - 1)
        value = np.empty(tau.shape)
        for index in np.unique(at):
            here = at == index
            start, width = self.breaks[index], self.breaks[index + 1] - self.breaks[index]
            local = np.clip((tau[here] - start) / width, 0.0, 1.0)
            value[here] = evaluate(differentiate(self.pieces[index], order), local) / width**order
        return value

    def derivative(self, order: int) -> list[Polynomial]:
        """The polynomials d^k f/dτ^k on the intervals, each over [0, 1]."""
        widths: list[float] = np.diff(self.breaks).tolist()
        return [
            Polynomial(differentiate(piece, order), bound_rounding(piece, order)) * width**-order
            for piece, width in zip(self.pieces, widths, strict=True)
        ]


def locate(times: Array, t: Array, side: Side) -> NDArray[np.int64]:
    """Index of the interval of `times` (n+1,) that holds each t, from the given side of a node.

    Raises:
        ValueError: t outside [times[0], times[-1]].
    """
    if np.any(~((t >= times[0]) & (t <= times[-1]))):
        raise ValueError(f"time outside [{times[0]:g}, {times[-1]:.17g}] s")
    return np.clip(np.searchsorted(times, t, side=side) - 1, 0, len(times) - 2)
