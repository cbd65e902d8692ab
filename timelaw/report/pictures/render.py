"""A picture of a law as the content of a file: SVG, PNG or PDF, the same for the same law."""

import io
import re
import warnings
from html import escape

from timelaw.motion import QuaternionLaw
from timelaw.report.pictures.registry import PICTURES
from timelaw.report.pictures.sketch import STYLE
from timelaw.report.pictures.view import AXIS_COLOURS, GRID, INK, MUTED, OMEGA, PAPER

METADATA: dict[str, dict[str, str | None]] = {
    ".svg": {"Date": None, "Creator": "timelaw"},
    ".png": {"Software": "timelaw"},
    ".pdf": {"CreationDate": None, "Creator": "timelaw", "Producer": None},
}
SUFFIXES = tuple(METADATA)
DOTS = 200  # per inch of a PNG
THEME = {
    INK: "ink",
    MUTED: "muted",
    PAPER: "paper",
    GRID: "grid",
    OMEGA: "axis-omega",
    **dict(zip(AXIS_COLOURS, ("axis-x", "axis-y", "axis-z"), strict=True)),
}


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
    told = f"<title>{escape(picture.title)}</title><desc>{escape(picture.describe(law))}</desc>"
    text = content.getvalue().decode()
    head = text.index(">", text.index("<svg")) + 1
    return f"{text[:head]}\n{told}{text[head:]}".encode()


def embed_picture(law: QuaternionLaw, name: str) -> str:
    """The SVG as a part of a page: named colours are the page's, identifiers that nothing refers to go."""
    text = render_picture(law, name, ".svg").decode()
    text = re.sub(r"\s*<metadata>.*?</metadata>", "", text[text.index("<svg") :], count=1, flags=re.DOTALL)
    text = re.sub(r' (?:width|height)="[^"]*pt"', "", text, count=2)
    referred = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', text))
    text = re.sub(r' id="([^"]+)"', lambda found: found[0] if found[1] in referred else "", text)
    text = text.replace("<svg ", f'<svg role="img" aria-label="{escape(PICTURES[name].describe(law))}" ', 1)
    return re.sub(
        r"#[0-9a-f]{6}\b", lambda m: f"var(--{THEME[m[0]]}, {m[0]})" if m[0] in THEME else m[0], text
    )
