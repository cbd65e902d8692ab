"""Pictures inside a page: its colours, identifiers of their own, a title and a description."""

import re
from collections.abc import Mapping
from html import escape

from timelaw.report.figures.style import THEME

JOINED = "stroke-linejoin: round; stroke-linecap: butt"  # what Matplotlib says of all elements of a page


def describe_picture(svg: str, key: str, title: str, description: str) -> str:
    """An SVG file's text with a title and a description that screen readers find."""
    head = svg.index(">", svg.index("<svg"))
    told = (
        f' role="img" aria-labelledby="{key}-title {key}-desc">\n'
        f'<title id="{key}-title">{escape(title)}</title>\n<desc id="{key}-desc">{escape(description)}</desc>'
    )
    return svg[:head] + told + svg[head + 1 :]


def inline_picture(svg: str, key: str, theme: Mapping[str, str] = THEME) -> str:
    """The same for a page: colours of a theme are the page's, no identifier is that of another picture."""
    text = svg[svg.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, count=1, flags=re.S)
    text = re.sub(r'\s*<defs>\s*<style type="text/css">.*?</style>\s*</defs>', "", text, count=1, flags=re.S)
    head = text.index(">")
    opening = re.sub(r' (?:width|height|version|xmlns(?::xlink)?)="[^"]*"', "", text[:head])
    text = f'{opening} style="{JOINED}"' + text[head:]
    return _name_colours(_own_identifiers(text, key), theme).replace("xlink:href", "href")


def _own_identifiers(text: str, key: str) -> str:
    """Identifiers that nothing refers to go, the others begin with the picture's key."""
    known = set(re.findall(r'(?:url\(#|href="#)([^)"]+)', text))
    text = re.sub(
        r' id="([^"]+)"',
        lambda m: f' id="{key}-{m[1]}"' if m[1] in known else m[0] if m[1].startswith(f"{key}-") else "",
        text,
    )
    return re.sub(r'(url\(#|href="#)', rf"\1{key}-", text)


def _name_colours(text: str, theme: Mapping[str, str]) -> str:
    """Each colour of the theme by its name; what the theme does not know stays."""
    return re.sub(r"#[0-9a-f]{6}\b", lambda m: f"var(--{theme[m[0]]})" if m[0] in theme else m[0], text)
