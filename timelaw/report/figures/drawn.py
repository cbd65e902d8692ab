"""What pictures ask of a design, whatever its route: its law, and those beside it."""

from collections.abc import Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from timelaw.easing import Timing
from timelaw.easing.piece_stack import sample_profiles
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array
from timelaw.numerics.function import enclose_peaks
from timelaw.pipeline import Certified
from timelaw.report.figures.channels import Channel, list_channels
from timelaw.report.figures.samples import Samples, sample_motion
from timelaw.report.figures.style import AXIS_COLOURS, DOUBLE_S, EVERY_STOP, QUINTIC, STOPPING
from timelaw.report.figures.window import choose_window, cut_alike
from timelaw.time_law import baselines
from timelaw.time_law.time_law import STOPPING_LAW

COLOURS = {
    baselines.QUINTIC: QUINTIC,
    baselines.DOUBLE_S: DOUBLE_S,
    baselines.EVERY_STOP: EVERY_STOP,
    STOPPING_LAW: STOPPING,
}

POINTS = 161  # of an easing
OTHERS = (DOUBLE_S, STOPPING, AXIS_COLOURS[2], AXIS_COLOURS[0], QUINTIC, EVERY_STOP)


class SampledEasings(NamedTuple):
    """The distinct easings, and their slopes, (n, m) each, at τ (m,)."""

    tau: Array
    values: tuple[Array, Array]


class Scene:
    """A design to be drawn, on canvases of several sizes: what all of them need is computed once."""

    def __init__(self, design: Any) -> None:
        self.design = design
        self.optimised: Certified = design.optimised
        self.baselines: tuple[Certified, ...] = design.baselines
        self.law = self.optimised.law
        self._easings: SampledEasings | None = None

    def choose_colour(self, name: str) -> str:
        """Of a law beside the first one, the same in all pictures; what is no baseline has one in turn."""
        if name in COLOURS:
            return COLOURS[name]
        others = [entry.name for entry in self.baselines if entry.name not in COLOURS]
        return OTHERS[others.index(name) % len(OTHERS)]

    def sample_easings(self, timings: Sequence[Timing]) -> SampledEasings:
        """Those of the design's timings, for all canvases."""
        if self._easings is None:
            distinct = list({timing.easing.key(): timing.easing for timing in timings}.values())
            tau = np.linspace(0.0, 1.0, POINTS)
            values = sample_profiles(distinct, tau, 0), sample_profiles(distinct, tau, 1)
            self._easings = SampledEasings(tau, values)
        return self._easings

    @cached_property
    def channels(self) -> list[Channel]:
        """What is drawn over time."""
        return list_channels(self.law)

    @cached_property
    def deviations(self) -> list[float]:
        """The largest angle [rad], as it is proved, by which each segment leaves its arc."""
        return measure_deviations(self.law)

    @cached_property
    def window(self) -> tuple[Segment, ...]:
        """The segments that are drawn in full."""
        return choose_window(self.law, self.optimised.certificate)

    @cached_property
    def whole(self) -> Samples:
        """All of the law."""
        return sample_motion(self.law, self.law.segments, self.optimised.certificate)

    @cached_property
    def part(self) -> Samples:
        """What is drawn in full of it."""
        return sample_motion(self.law, self.window, self.optimised.certificate)

    @cached_property
    def beside(self) -> list[tuple[str, Samples]]:
        """The same legs of the baselines, by name."""
        cut = [(entry, cut_alike(self.law, self.window, entry.law)) for entry in self.baselines]
        return [(entry.name, sample_motion(entry.law, part)) for entry, part in cut]


def measure_deviations(law: QuaternionLaw) -> list[float]:
    """The largest angle [rad], as it is proved, by which each segment leaves its arc."""
    parts = [list(segment.list_deviations()) for segment in law.segments]
    tops = iter(enclose_peaks([part.value for own in parts for part in own]))
    return [max((part.row.size(next(tops).upper) for part in own), default=0.0) for own in parts]
