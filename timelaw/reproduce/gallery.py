"""The gallery: `python -m timelaw.reproduce.gallery timelaw/docs/gallery.md problems/*.yaml`.

Each problem is designed anew, the traces of its body axes drawn small beside the page, in `gallery/`, and the
table between the page's marks replaced.
"""

import io
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path

from timelaw.face import design
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report import list_law_rows
from timelaw.report.curves.outcome import list_curve_tiles
from timelaw.report.headline import Tile, list_tiles
from timelaw.report.pictures.render import render_picture
from timelaw.reproduce.command import run_main
from timelaw.reproduce.readme_tables import format_markdown, replace_table

MARK = "gallery"
HEADINGS = ("motion", "problem file", "what came of it")
WIDTH, QUALITY = 240, 80  # pixels, and of the WebP file


def shrink(png: bytes) -> bytes:
    """A picture as a small WebP file."""
    from PIL import Image

    content = io.BytesIO()
    with Image.open(io.BytesIO(png)) as picture:
        height = round(picture.height * WIDTH / picture.width)
        small = picture.convert("RGB").resize((WIDTH, height), Image.Resampling.LANCZOS)
    small.save(content, format="WEBP", quality=QUALITY)
    return content.getvalue()


def show_problem(path: Path, folder: Path) -> list[str]:
    """A row of the table; the picture is written into the folder."""
    found = design(path)
    certified = found.optimised.certificate.holds
    tiles: list[Tile]
    if isinstance(found, BezierDesign):
        tiles = list_curve_tiles(found)
    else:
        tiles = list_tiles(found, list_law_rows(found))
    (folder / f"{path.stem}.webp").write_bytes(shrink(render_picture(found.law, "traces", ".png")))
    told = "<br>".join(f"**{tile.number}** {tile.words}" for tile in tiles)
    verdict = "certified" if certified else "NOT certified"
    name = f"[{path.stem}](../../problems/{path.name})"
    told = told.replace("|", "\\|")  # which ends a cell
    return [f"![{path.stem}]({folder.name}/{path.stem}.webp)", name, f"{told}<br>{verdict}"]


def main(arguments: Sequence[str]) -> None:
    """Design every problem and rewrite page and pictures."""
    parser = ArgumentParser(description="make the gallery of problem files again")
    parser.add_argument("page", type=Path)
    parser.add_argument("problems", type=Path, nargs="+")
    given = parser.parse_args(arguments)
    folder = given.page.parent / given.page.stem
    folder.mkdir(exist_ok=True)
    rows = [show_problem(path, folder) for path in sorted(given.problems, key=lambda path: path.stem)]
    text = given.page.read_text(encoding="utf-8")
    given.page.write_text(replace_table(text, format_markdown(HEADINGS, rows), MARK), encoding="utf-8")


if __name__ == "__main__":
    run_main(main)
