"""Names of columns as programs write them: in a comment, with frames or empty units; places among them."""

import re
from collections.abc import Collection, Sequence

from timelaw.orientations.forms import FORMS

NO_UNIT = re.compile(r"\s*(\[\s*[-1]?\s*\]|\(\s*\))$")  # as in "q_RS_w []"; other units mean something
FRAMED = re.compile(r"q_(?:[a-z0-9]+_)*([wxyz])")
PLACE = re.compile(r"(?:t|p|pos_?|position_?|p_(?:[a-z0-9]+_)*)?([xyz])(?:\s*[\[(].*[\])])?")


def clean_name(cell: str) -> str:
    """A column's name in small letters: "q_RS_w []" is qw."""
    name = NO_UNIT.sub("", cell.strip().lower())
    framed = FRAMED.fullmatch(name)
    return f"q{framed.group(1)}" if framed else name


def find_commented_header(
    comments: Sequence[str], separator: str, width: int, wanted: Collection[str]
) -> list[str] | None:
    """The names in the last comment before a table of `width` columns, if it names those of an orientation.

    These are the `wanted` ones, or those that some form has.
    """
    text = next((line.strip() for line in reversed(comments) if line.strip()), "").lstrip("#").strip()
    cells = text.split() if separator == " " else [cell.strip() for cell in text.split(separator)]
    names = {clean_name(cell) for cell in cells}
    sets = (
        [{clean_name(name) for name in wanted}]
        if wanted
        else [set(c) for f in FORMS.values() for c in f.columns]
    )
    return cells if len(cells) == width and any(own <= names for own in sets) else None


def describe_places(header: Sequence[str], taken: Sequence[int], width: int, source: str) -> tuple[str, ...]:
    """The one line about positions beside the orientations, which nothing here moves by.

    Without a header nobody knows what the other columns are; they are named.
    """
    others = [i for i in range(width) if i not in taken]
    if not header:
        listing = ", ".join(str(i + 1) for i in others)
        return (f"of the {width} columns of {source} those numbered {listing} are ignored",) if others else ()
    found = {match.group(1): header[i] for i in others if (match := PLACE.fullmatch(header[i].lower()))}
    if set(found) != set("xyz"):
        return ()
    listing = ", ".join(found[axis] for axis in "xyz")
    return (f"the positions in columns {listing} of {source} are ignored: only orientations are taken",)
