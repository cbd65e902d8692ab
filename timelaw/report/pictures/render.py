"""A picture of a law as the content of a file: SVG, PNG or PDF, the same for the same law."""

import io
import warnings
from typing import TYPE_CHECKING

from timelaw.motion import QuaternionLaw
from timelaw.report.figures.embed import describe_picture, inline_picture
from timelaw.report.pictures.registry import PICTURES
from timelaw.report.pictures.sketch import STYLE

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Figure

METADATA: dict[str, dict[str, str | None]] = {
    ".svg": {"Date": None, "Creator": "timelaw"},
    ".png": {"Software": "timelaw"},
    ".pdf": {"CreationDate": None, "Creator": "timelaw", "Producer": None},
}
SUFFIXES = tuple(METADATA)
DOTS = 200  # per inch of a PNG
QUALITY = 80  # of a WebP file


def render_picture(law: QuaternionLaw, name: str, suffix: str) -> bytes:
    """The picture of that name in `PICTURES`, in the format of a suffix in `SUFFIXES`."""
    import matplotlib as mpl

    picture = PICTURES[name]
    content = io.BytesIO()
    with mpl.rc_context({**STYLE, "svg.hashsalt": name}), warnings.catch_warnings():
        # letters of labels: the reader of an SVG has them, elsewhere a box stands for what no font has
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        figure = picture.draw(law)
        figure.savefig(content, format=suffix[1:], dpi=DOTS, metadata=METADATA[suffix])
    if suffix != ".svg":
        return content.getvalue()
    text = content.getvalue().decode()
    return describe_picture(text, f"view-{name}", picture.title, picture.describe(law)).encode()


def render_small(law: QuaternionLaw, name: str, width: int) -> bytes:
    """The picture of that name as a WebP file so many pixels wide."""
    from PIL import Image

    content = io.BytesIO()
    with Image.open(io.BytesIO(render_picture(law, name, ".png"))) as picture:
        height = round(picture.height * width / picture.width)
        small = picture.convert("RGB").resize((width, height), Image.Resampling.LANCZOS)
    small.save(content, format="WEBP", quality=QUALITY)
    return content.getvalue()


def draw_picture(law: QuaternionLaw, name: str) -> "Figure":
    """The picture of that name as a figure of Matplotlib's, to be changed and saved."""
    import matplotlib as mpl

    with mpl.rc_context(STYLE):
        figure: Figure = PICTURES[name].draw(law)
    return figure


def embed_picture(law: QuaternionLaw, name: str) -> str:
    """The SVG as a part of a page."""
    return inline_picture(render_picture(law, name, ".svg").decode(), f"view-{name}")
