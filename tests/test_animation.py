"""Moving pictures: what is read back is what was drawn, frame by frame, in bounded memory; errors say what to do."""

import io
import json
import os
import weakref
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.pages import PAGES, list_lines
from timelaw.cli.animate import MOST_FRAMES
from timelaw.cli.app import run_command
from timelaw.law_file import read_law
from timelaw.report.animation.film import Film
from timelaw.report.animation.formats import FORMATS, write_gif, write_mp4, write_webp
from timelaw.report.animation.pen import Pen, mix
from timelaw.report.figures.style import AXIS_COLOURS
from timelaw.report.pictures.view import View

ROOT = Path(__file__).parent.parent
LAW = ROOT / "results/paper-24-cell-through/law.json"
MOVING = ROOT / "tests/fuzz/corpus/law/points.json"
STUB = """#!/usr/bin/env python3
import sys
open(sys.argv[-1], "wb").write(b" ".join(a.encode() for a in sys.argv[1:]) + b"\\n" + sys.stdin.buffer.read())
"""


@pytest.fixture(scope="module")
def film():
    return Film(read_law(LAW)[0], rate=3, speed=6, size=64)


@pytest.fixture
def program(tmp_path, monkeypatch):
    """Puts a program called ffmpeg, and nothing else but Python, on the path."""

    def install(text):
        file = tmp_path / "bin" / "ffmpeg"
        file.parent.mkdir()
        file.write_text(text)
        file.chmod(0o755)
        monkeypatch.setenv("PATH", f"{file.parent}{os.pathsep}{os.environ['PATH']}")

    return install


def test_frames_are_at_a_steady_rate_and_the_last_is_the_end(film):
    assert film.count == 13
    np.testing.assert_allclose(np.diff(film.times)[:-1], 2.0)
    assert film.times[-1] == film.law.duration
    assert sum(film.delays[:-1]) == pytest.approx(1000 * 12 / 3, abs=10)
    assert Film(film.law, rate=1, speed=1e6, size=64).count == 2


@pytest.mark.parametrize("write", [write_gif, write_webp])
def test_what_is_read_back_is_what_was_drawn(film, write):
    expected = np.array(film.palette.getpalette(), dtype=np.uint8).reshape(-1, 3)
    assert tuple(expected[next(film.reduce_frames())[0, -1]]) == (255, 255, 255)
    with Image.open(io.BytesIO(write(film))) as read:
        assert (read.n_frames, read.info["loop"]) == (film.count, 0)
        shown = 0
        for number, indices in enumerate(film.reduce_frames()):
            read.seek(number)
            read.load()
            np.testing.assert_array_equal(np.asarray(read.convert("RGB")), expected[indices])
            shown += read.info["duration"]
    assert shown == sum(film.delays)


def test_the_axes_end_where_the_law_has_them(film):
    """The tip of every axis on the near side has its colour, at the place that projection gives."""
    big = Film(film.law, 3, 6, 300)
    t = 7.3
    image = np.asarray(big._draw(t)).astype(int)
    tips = View().project(film.law.rotation(t).T)
    assert np.sum(tips[:, 2] >= 0) >= 1
    for tip, colour in zip(tips, AXIS_COLOURS, strict=True):
        if tip[2] < 0:
            continue
        place = 0.97 * tip[:2] * [1, -1]  # in the arrow's head
        x, y = np.rint(150 + 150 * place / Pen.margin).astype(int)
        wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
        assert np.min(np.max(np.abs(image[y - 2 : y + 3, x - 2 : x + 3] - wanted), axis=2)) < 40


def test_a_body_that_travels_is_shown_in_space():
    film = Film(read_law(MOVING)[0], rate=1, speed=1, size=64)
    frames = [frame.tobytes() for frame in film.draw_frames()]
    assert len(set(frames)) == len(frames)  # it rests at first, and its clock goes on


def test_frames_are_not_kept(film, monkeypatch):
    seen, most = [], []
    inner = Film.draw_frames

    def watched(self, progress=None):
        for frame in inner(self, progress):
            seen.append(weakref.ref(frame))
            most.append(sum(known() is not None for known in seen))
            yield frame
            del frame

    monkeypatch.setattr(Film, "draw_frames", watched)
    for write in (write_gif, write_webp):
        write(film)
    assert max(most) <= 2


def test_progress_is_told_of_every_frame(film):
    told = []
    write_gif(film, lambda *seen: told.append(seen))
    assert told == [("drawing frames", k, film.count) for k in range(film.count)]


def test_ffmpeg_is_handed_every_frame_and_the_last_for_a_second(film, program):
    program(STUB)
    head, content = write_mp4(film).split(b"\n", 1)
    assert b"rawvideo" in head
    assert b"-s 64x64 -r 3 -i -" in head
    frames = [frame.tobytes() for frame in film.draw_frames()]
    assert content == b"".join([*frames, *[frames[-1]] * 3])


def test_what_ffmpeg_says_is_told(program, capsys, tmp_path):
    program("#!/bin/sh\necho 'no such codec' >&2\nexit 3\n")
    out = tmp_path / "out.mp4"
    assert run_command(["animate", str(LAW), "-o", str(out), "--speed", "20", "--size", "64"]) == 2
    assert "ffmpeg failed: no such codec" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["-o", "out.avi"], '-o "out.avi": a name that ends in .gif, .webp, .mp4 is needed'),
        (
            ["-o", "out.mp4"],
            "an .mp4 needs the program ffmpeg, which is not installed; .gif and .webp do not",
        ),
        (
            ["-o", "out.gif", "--speed", "0.01"],
            f"at most {MOST_FRAMES} are drawn, choose a --speed above 0.0296",
        ),
        (["-o", "out.gif", "--rate", "nan"], "nan is not a number"),
        (["-o", "out.gif", "--size", "10"], "'--size': 10 is not in the range"),
    ],
)
def test_what_cannot_be_filmed_is_refused(arguments, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert run_command(["animate", str(LAW), *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_odd_size_is_refused_where_it_cannot_be(program, capsys, tmp_path):
    program(STUB)
    assert run_command(["animate", str(LAW), "-o", str(tmp_path / "out.mp4"), "--size", "65"]) == 2
    assert "--size 65: an .mp4 needs an even number of pixels" in capsys.readouterr().err


def test_the_command_writes_the_film_and_says_so(capsys, tmp_path):
    file = tmp_path / "out.gif"
    assert run_command(["animate", str(LAW), "-o", str(file), "--speed", "50", "--size", "64", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["frames"], told["bytes"]) == (13, file.stat().st_size)
    assert set(FORMATS) == {".gif", ".webp", ".mp4"}


def test_the_readmes_film_is_small_and_made_by_the_command_that_is_shown():
    readme = PAGES["README"]
    first = readme[readme.index("![") :].split("(")[1].split(")")[0]
    command = next(line for line in list_lines() if line.startswith("timelaw animate")).split()
    given = {name: float(value) for name, value in pairwise(command) if name.startswith("--")}
    made = Film(read_law(LAW)[0], given["--rate"], given["--speed"], int(given["--size"]))
    assert (ROOT / first).stat().st_size < 400_000
    with Image.open(ROOT / first) as read:
        assert (read.n_frames, read.size) == (made.count, (made.size, made.size))


def test_colours_are_mixed_by_parts():
    assert mix("#000000", 0.25) == "#bfbfbf"
    assert mix("#102030", 1.0) == "#102030"
