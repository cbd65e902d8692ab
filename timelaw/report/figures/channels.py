"""What pictures draw over time: each limited quantity, in its unit, with its sign, by the law's numbers."""

from dataclasses import dataclass
from math import inf, pi

import numpy as np

from timelaw.limits import LIMITS, Limit
from timelaw.limits.registry import POINT
from timelaw.limits.row import ORDERS
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.report.figures.samples import Samples

ALWAYS = ("velocity", "acceleration", "jerk")  # drawn, limited or not
SYMBOLS = {
    "velocity": "ω",
    "acceleration": "α",
    "jerk": "jerk",
    "snap": "snap",
    "torque": "τ",
    "momentum": "h",
    "linear_velocity": "v",
    "linear_acceleration": "a",
}
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PLAIN = (-2, 3)  # powers of ten between which numbers are written as they are


def find_power(top: float) -> int:
    """The power of ten, a multiple of three, in which the numbers of an axis up to `top` are short."""
    power = int(np.floor(np.log10(top))) if top > 0 else 0
    return 0 if PLAIN[0] <= power <= PLAIN[1] else 3 * (power // 3)


@dataclass(frozen=True)
class Channel:
    """One quantity of a law: `name` is its limit's key, `signed` if its axes have bounds of their own."""

    name: str
    limit: Limit
    signed: bool

    @property
    def unit(self) -> str:
        """As it is shown, angles in degrees."""
        return self.limit.unit.replace("rad", "deg")

    @property
    def scale(self) -> float:
        """From SI to the unit that is shown."""
        return 180 / pi if "rad" in self.limit.unit else 1.0

    @property
    def words(self) -> str:
        """What it is called."""
        return f"angular {self.name}" if self.name in ORDERS else self.name.replace("_", " ")

    def name_panel(self, top: float) -> tuple[str, str]:
        """Its name, symbol and unit, and without the name; the letters of its axes follow.

        `top` is the largest number on the panel's axis, which may be written by powers of ten.
        """
        power = find_power(top)
        factor = f"10{str(power).translate(RAISED)} " if power else ""
        way = "along" if LIMITS[self.name].needs_translation else "about"
        symbol = SYMBOLS[self.name]
        shown = f"{symbol}, {factor}{self.unit}, {way}" if self.signed else f"|{symbol}|, {factor}{self.unit}"
        return f"{self.words} {shown}".replace(f"{symbol} {symbol}", symbol), shown

    def measure(self, samples: Samples) -> Array:
        """The vector (n, 3) at all instants, in the unit that is shown."""
        vector = self.limit.vector(samples.rates, list(samples.momentum.T))
        parts = [np.broadcast_to(part, samples.times.shape) for part in vector]
        return self.scale * np.stack(parts, axis=-1)

    def bound_on(self, law: QuaternionLaw, segment: Segment) -> tuple[float, Array]:
        """Bounds on the norm and on the components (3,) there, infinite where there are none."""
        norm, axes = inf, np.full(3, inf)
        for limits in (law.limits, segment.limits):
            given = limits.get(self.name)
            if isinstance(given, tuple):
                axes = np.minimum(axes, given)
            elif given is not None:
                norm = min(norm, given)
        return self.scale * norm, self.scale * axes


def list_channels(law: QuaternionLaw) -> list[Channel]:
    """The three rates, and what else is limited on the motion or on any segment of it."""
    given = [law.limits, *(segment.limits for segment in law.segments)]
    found = []
    for name, kind in LIMITS.items():
        bounds = [limits[name] for limits in given if name in limits]
        if bounds or name in ALWAYS:
            limit = kind.make(bounds[0] if bounds else 1.0, law.body or POINT)
            found.append(Channel(name, limit, any(isinstance(b, tuple) for b in bounds)))
    return found


@dataclass(frozen=True)
class Trace:
    """A channel over segments: its `values` (n, 3) at the instants of the samples."""

    channel: Channel
    samples: Samples
    values: Array

    @property
    def segments(self) -> tuple[Segment, ...]:
        """Over which it goes."""
        return self.samples.segments

    @property
    def times(self) -> Array:
        """Its instants (n,) [s]."""
        return self.samples.times

    @property
    def norm(self) -> Array:
        """|value| (n,)."""
        return np.asarray(np.linalg.norm(self.values, axis=1))

    def largest(self) -> float:
        """Of what is drawn: the norm is always among it."""
        return float(np.max(self.norm))

    def envelope(self) -> tuple[Array, Array]:
        """Least and greatest values (s, 3) on each segment."""
        begins = self.samples.begins
        return np.minimum.reduceat(self.values, begins), np.maximum.reduceat(self.values, begins)

    def largest_norms(self) -> Array:
        """The largest norm (s,) on each segment."""
        return np.asarray(np.maximum.reduceat(self.norm, self.samples.begins))


def trace_channel(channel: Channel, samples: Samples) -> Trace:
    """The course of a channel."""
    return Trace(channel, samples, channel.measure(samples))
