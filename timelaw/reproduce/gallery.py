"""The gallery: `python -m timelaw.reproduce.gallery timelaw/docs/gallery.md problems/*.yaml`.

Each problem is designed anew, the traces of its body axes drawn small beside the page, in `gallery/`, and the
table between the page's marks replaced.
"""

from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path

from timelaw.pipeline import Design, design_problem
from timelaw.pipeline_bezier import BezierDesign, design_curves
from timelaw.problem import load_problem
from timelaw.report import list_law_rows
from timelaw.report.curves.outcome import list_curve_tiles
from timelaw.report.headline import Tile, list_tiles
from timelaw.report.pictures.render import render_small
from timelaw.reproduce.command import run_main
from timelaw.reproduce.reference_tables import format_markdown, replace_table

MARK = "gallery"
HEADINGS = ("motion", "problem file", "what came of it")
WIDTH = 240  # pixels


def design_file(path: Path) -> Design | BezierDesign:
    """The design of a problem file of either kind."""
    problem, source = load_problem(path)
    return (design_curves if problem.route.bezier else design_problem)(path, problem, source)


def show_problem(path: Path, folder: Path) -> list[str]:
    """A row of the table; the picture is written into the folder."""
    found = design_file(path)
    law, certified = found.optimised.law, found.optimised.certificate.holds
    tiles: list[Tile]
    if isinstance(found, BezierDesign):
        tiles = list_curve_tiles(found)
    else:
        tiles = list_tiles(found, list_law_rows(found))
    (folder / f"{path.stem}.webp").write_bytes(render_small(law, "traces", WIDTH))
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
