"""What a frame shows: the body on the sphere of its axes' traces, or where it is in space."""

from typing import Any

import numpy as np

from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array
from timelaw.report.animation.pen import Pen, mix
from timelaw.report.figures.style import AXIS_COLOURS, GRID_LINE, INK, OMEGA
from timelaw.report.pictures.sampling import sample_times
from timelaw.report.pictures.view import View, list_circles, size_box, split_sides

MANY = 60  # legs; of more the whole traces are faint
TRAIL = 2.0  # legs of mean duration that the strong part of a trace is long
REACH = 0.95  # of the sphere's radius, the length of the greatest angular velocity


class SphereStage:
    """The body at the centre of the unit sphere, the far half of everything behind it."""

    def __init__(self, law: QuaternionLaw, size: int) -> None:
        self.law, self.view = law, View()
        self.half = size_box(law.shape)
        self.times = sample_times(law)
        self.fastest = float(law.find_largest()[0])
        self.trail = TRAIL * law.duration / max(len(law.legs), 1)
        paths = np.moveaxis(self.view.project(np.moveaxis(law.rotation(self.times), 2, 1)), 1, 0)
        self.paths = [split_sides(path) for path in paths]
        self.near, self.far = Pen(size, self.view, clear=True), Pen(size, self.view)
        self._draw_ground()

    def _draw_ground(self) -> None:
        """What does not move, on its side."""
        many = len(self.law.legs) > MANY
        for circle in list_circles():
            near, far = split_sides(self.view.project(circle))
            self.far.line(far, mix(GRID_LINE, 0.5), 0.5)
            self.near.line(near, GRID_LINE, 0.5)
        ring = np.linspace(0.0, 2 * np.pi, 181)
        self.near.line(np.column_stack([np.cos(ring), np.sin(ring)]), GRID_LINE, 1.0)
        nodes = self.view.project(np.moveaxis(self.law.rotation(self.law.times), 2, 1))
        for axis, (colour, (near, far)) in enumerate(zip(AXIS_COLOURS, self.paths, strict=True)):
            self.far.line(far, mix(colour, 0.12 if many else 0.3), 1.0)
            self.near.line(near, mix(colour, 0.25 if many else 0.6), 1.0)
            for place in () if many else nodes[:, axis]:
                pen = self.near if place[2] >= 0 else self.far
                pen.dot(place[:2], mix(colour, 1.0 if place[2] >= 0 else 0.5), 2.2, filled=place[2] >= 0)

    def draw(self, t: float) -> Any:
        """The frame at a time [s]."""
        rotation, omega = self.law.rotation(t), self.law(t, 1)
        pen = self.far.copy()
        self._draw_trail(pen, t, rotation, side=1)
        pen.box(rotation, self.half, np.zeros(2), 1.0, 1.0)
        tip = self.view.project(rotation @ omega)[:2] * (REACH / self.fastest if self.fastest else 0.0)
        pen.arrow(np.zeros(2), tip, OMEGA, 2.6, "ω")
        pen.lay_over(self.near)
        self._draw_trail(pen, t, rotation, side=0)
        pen.write(f"{t:.1f} s", INK)
        return pen.finish()

    def _draw_trail(self, pen: Pen, t: float, rotation: Array, side: int) -> None:
        """The last part of the traces, on the near (0) or far (1) side."""
        first, last = np.searchsorted(self.times, [t - self.trail, t], side="right")
        tips = self.view.project(rotation.T)
        for axis, colour in enumerate(AXIS_COLOURS):
            path = self.paths[axis][side][first:last]
            if (tips[axis, 2] >= 0) == (side == 0):
                path = np.concatenate([path, tips[axis : axis + 1, :2]])
            if len(path):
                pen.line(path, colour if side == 0 else mix(colour, 0.5), 2.2)


class SpaceStage:
    """The body as a box at its place in the world, and the way of its origin."""

    def __init__(self, law: QuaternionLaw, size: int) -> None:
        self.law, self.view = law, View()
        self.half = size_box(law.shape) if law.shape is None else np.array(law.shape) / 2
        self.times = sample_times(law)
        way = law.place(self.times)
        self.middle = (np.min(way, axis=0) + np.max(way, axis=0)) / 2
        reach = float(np.max(np.linalg.norm(way - self.middle, axis=1)))
        self.scale = 1 / (reach + float(np.linalg.norm(self.half)))
        self.long = float(np.max(self.half)) + 0.3 * reach
        self.way = self._place(way)
        self.ground = Pen(size, self.view)
        for axis in np.eye(3) * 0.95:
            self.ground.line(self.view.project(np.stack([-axis, axis]))[:, :2], GRID_LINE, 0.8)
        self.ground.line(self.way, mix(INK, 0.4), 1.0)
        for node in self._place(law.place(law.times)):
            self.ground.dot(node, INK, 2.2)

    def _place(self, points: Array) -> Array:
        return np.asarray(self.view.project((points - self.middle) * self.scale)[..., :2])

    def draw(self, t: float) -> Any:
        """The frame at a time [s]."""
        pen, here = self.ground.copy(), self._place(self.law.place(t))
        gone = self.way[: np.searchsorted(self.times, t, side="right")]
        pen.line(np.concatenate([gone, here[None]]), INK, 1.8)
        pen.box(self.law.rotation(t), self.half, here, self.scale, self.long)
        pen.write(f"{t:.1f} s", INK)
        return pen.finish()
