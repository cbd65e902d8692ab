"""A law's motion as frames at a steady rate, and the colours that all of them need."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.progress import Progress
from timelaw.report.animation.stage import SpaceStage, SphereStage

Pixels = NDArray[np.uint8]
HOLD = 1.0  # seconds that the last frame stays
NEAR_END = 1e-6  # of a frame: one that close to the end is the end, but for rounding
COLOURS = 255  # of a palette, and one that is see-through
WHITE = (255, 255, 255)
SAMPLED = 12  # frames from which the palette is taken


@dataclass(frozen=True)
class Film:
    """A law shown `rate` times a second, `speed` times as fast as it is, in `size` pixels each way."""

    law: QuaternionLaw
    rate: float
    speed: float
    size: int

    @property
    def count(self) -> int:
        """How many frames there are, start and end among them."""
        return max(ceil(self.law.duration * self.rate / self.speed - NEAR_END), 1) + 1

    @cached_property
    def times(self) -> Array:
        """Of the frames [s], the last the end of the motion."""
        steps = np.linspace(0.0, (self.count - 1) * self.speed / self.rate, self.count)
        return np.append(steps[:-1], self.law.duration)

    @property
    def delays(self) -> list[int]:
        """How long each frame stays [ms], in steps of ten that never fall behind by more than one."""
        ends = np.arange(1, self.count) * (1000 / self.rate)
        ends = np.append(ends, ends[-1] + 1000 * HOLD)
        return [round(delay) for delay in np.diff(10 * np.rint(ends / 10), prepend=0.0)]

    @cached_property
    def _draw(self) -> Callable[[float], Any]:
        """The frame at a time."""
        stage = SpaceStage if self.law.travels else SphereStage
        return stage(self.law, self.size).draw

    def draw_frames(self, progress: Progress | None = None) -> Iterator[Any]:
        """The images in turn, none of which is kept."""
        for number, t in enumerate(self.times.tolist()):
            if progress is not None:
                progress("drawing frames", number, self.count)
            yield self._draw(t)

    @cached_property
    def palette(self) -> Any:
        """An image of the colours that frames from all over the motion have."""
        from PIL import Image

        strip = Image.new("RGB", (self.size * SAMPLED, self.size))
        for number, t in enumerate(np.linspace(0.0, self.law.duration, SAMPLED).tolist()):
            strip.paste(self._draw(t), (number * self.size, 0))
        found: Any = strip.quantize(COLOURS - 1)
        found.putpalette([*found.getpalette()[: 3 * (COLOURS - 1)], *WHITE])
        return found

    def reduce_frames(self, progress: Progress | None = None) -> Iterator[Pixels]:
        """The frames as indices (size, size) of the palette's colours."""
        for image in self.draw_frames(progress):
            pixels = np.array(image.quantize(palette=self.palette, dither=0), dtype=np.uint8)
            # Pillow takes one colour for all that are nearly alike; the ground is to be as white as the page
            pixels[np.all(np.asarray(image) == WHITE, axis=-1)] = COLOURS - 1
            yield pixels
