"""Lines, boxes and letters on an image that is drawn larger than it is shown, so that edges are smooth."""

from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.report.figures.style import AXIS_COLOURS, INK, PAPER
from timelaw.report.pictures.view import View, list_faces

LARGER = 3  # times, in each direction
THIN = 0.0028  # of the picture's width, a line of width one
Point = tuple[float, float]


def mix(colour: str, part: float, ground: str = PAPER) -> str:
    """A colour laid over another, so thick that this part of it is seen."""
    both = [np.array([int(c[k : k + 2], 16) for k in (1, 3, 5)]) for c in (colour, ground)]
    red, green, blue = np.rint(part * both[0] + (1 - part) * both[1]).astype(int).tolist()
    return f"#{red:02x}{green:02x}{blue:02x}"


class Pen:
    """Draws on a square image, where right and up of the view go from -1 to 1 and a little beyond."""

    margin = 1.14  # of the picture's half, in the view's units

    def __init__(self, size: int, view: View, *, clear: bool = False) -> None:
        from PIL import Image, ImageDraw

        self.pixels = size * LARGER
        self.view = view
        mode, ground = ("RGBA", (255, 255, 255, 0)) if clear else ("RGB", PAPER)
        self.image = Image.new(mode, (self.pixels, self.pixels), ground)
        self._draw: Any = ImageDraw.Draw(self.image)

    def copy(self) -> "Pen":
        """Another with the same drawing."""
        from PIL import ImageDraw

        other = object.__new__(Pen)
        other.pixels, other.view, other.image = self.pixels, self.view, self.image.copy()
        other._draw = ImageDraw.Draw(other.image)
        return other

    def place(self, points: Array) -> list[Point]:
        """Pixels of points (..., 2 or more) of the view."""
        half = self.pixels / 2
        flat = half + np.asarray(points)[..., :2] * [half / self.margin, -half / self.margin]
        return [(float(x), float(y)) for x, y in np.reshape(flat, (-1, 2))]

    def line(self, points: Array, colour: str, width: float) -> None:
        """A line through points (m, 2) of the view; it stops where they are not numbers."""
        thick = max(round(width * THIN * self.pixels), 1)
        gaps = np.flatnonzero(~np.isfinite(points[:, 0]))
        for part in np.split(points, gaps):
            kept = part[np.isfinite(part[:, 0])]
            if len(kept) > 1:
                self._draw.line(self.place(kept), fill=colour, width=thick, joint="curve")

    def dot(self, point: Array, colour: str, radius: float, *, filled: bool = True) -> None:
        """A disc or ring about a point (2,) of the view."""
        ((x, y),) = self.place(point)
        r = radius * THIN * self.pixels
        inside = colour if filled else PAPER
        self._draw.ellipse((x - r, y - r, x + r, y + r), fill=inside, outline=colour, width=LARGER)

    def arrow(self, start: Array, end: Array, colour: str, width: float, label: str = "") -> None:
        """From one point (2,) to another, with a head, and a letter beyond it."""
        self.line(np.stack([start, end]), colour, width)
        (x, y), (u, v) = self.place(np.stack([start, end]))
        long = float(np.hypot(u - x, v - y))
        if long < 2 * LARGER:
            return
        along = np.array([u - x, v - y]) / long
        size = min((4 + 2 * width) * THIN * self.pixels, long)
        back, aside = np.array([u, v]) - size * along, 0.42 * size * np.array([-along[1], along[0]])
        self._draw.polygon([(u, v), tuple(back + aside), tuple(back - aside)], fill=colour)
        if label:
            place = np.array([u, v]) + 0.03 * self.pixels * along
            font = load_font(self.pixels, bold=True)
            self._draw.text(tuple(place), label, fill=colour, font=font, anchor="mm")

    def box(self, rotation: Array, half: Array, centre: Array, scale: float, reach: float) -> None:
        """A box turned by R (3, 3) about `centre` (2,) of the view, its axes as long as `reach`."""
        view = self.view
        faces = list_faces(rotation, half, view)

        def draw_axes(*, towards: bool) -> None:
            for axis in range(3):
                direction = rotation[:, axis]
                if (direction @ view.frame[2] >= 0) == towards:
                    ends = view.project(np.stack([half[axis] * direction, reach * direction]))[:, :2]
                    start, end = ends * scale + centre
                    self.arrow(start, end, AXIS_COLOURS[axis], 2.0, "xyz"[axis])

        draw_axes(towards=False)
        for face in faces:
            tint = AXIS_COLOURS[face.axis] if face.sense > 0 else INK
            part = 0.25 + 0.35 * face.facing if face.sense > 0 else 0.06 + 0.14 * face.facing
            corners = self.place(view.project(face.corners)[:, :2] * scale + centre)
            self._draw.polygon(corners, fill=mix(tint, part))
            thick = max(round(THIN * self.pixels), 1)
            self._draw.line([*corners, corners[0]], fill=INK, width=thick, joint="curve")
        draw_axes(towards=True)

    def write(self, text: str, colour: str) -> None:
        """Words in the lower left corner."""
        edge = 0.025 * self.pixels
        place = (edge, self.pixels - edge)
        self._draw.text(place, text, fill=colour, font=load_font(self.pixels, bold=False), anchor="ls")

    @cached_property
    def sheet(self) -> tuple[Any, Any]:
        """A finished drawing on clear ground: its colours, and how thick they are."""
        return self.image.convert("RGB"), self.image.getchannel("A")

    def lay_over(self, other: "Pen") -> None:
        """A finished drawing on clear ground over this one."""
        colours, thickness = other.sheet
        self.image.paste(colours, (0, 0), thickness)

    def finish(self) -> Any:
        """The image as it is shown."""
        return self.image.reduce(LARGER)


def load_font(pixels: int, *, bold: bool) -> Any:
    """Letters in proportion to the picture."""
    import matplotlib as mpl
    from PIL import ImageFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(Path(mpl.get_data_path()) / "fonts" / "ttf" / name, round(0.036 * pixels))
