"""The gallery has every problem file, with a small picture, and what its report says first."""

import re
from pathlib import Path

import pytest
from PIL import Image

from tests.cases import PROBLEMS
from timelaw.reproduce.gallery import WIDTH, show_problem

PAGE = Path(__file__).parent.parent / "timelaw" / "docs" / "gallery.md"
NAMES = sorted(path.stem for path in PROBLEMS.glob("*.yaml"))


def test_every_problem_file_is_in_it():
    rows = re.findall(r"^\| !\[([\w-]+)\]", PAGE.read_text(encoding="utf-8"), flags=re.M)
    assert rows == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_pictures_are_small(name):
    picture = PAGE.parent / "gallery" / f"{name}.webp"
    assert picture.stat().st_size < 20_000
    with Image.open(picture) as found:
        assert found.width == WIDTH


def test_a_row_is_made_as_it_stands(tmp_path):
    row = "| " + " | ".join(show_problem(PROBLEMS / "first-steps.yaml", tmp_path)) + " |"
    assert row.replace(tmp_path.name, "gallery") in PAGE.read_text(encoding="utf-8").splitlines()
    assert (tmp_path / "first-steps.webp").exists()
