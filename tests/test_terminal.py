"""What is said on a terminal: progress with time and solvers' steps, or nothing; long tours summed up."""

import io
import json
import os
import re
import sys

import pytest

from tests.cases import PROBLEMS
from timelaw.cli.app import run_command
from timelaw.cli.console import show_progress
from timelaw.cli.table import format_table
from timelaw.progress import count_steps, read_steps

LAW = PROBLEMS.parent / "results" / "paper-24-cell" / "law.json"


class Terminal(io.StringIO):
    """A stream that somebody looks at."""

    def isatty(self):
        return True


def watch(monkeypatch):
    """From now on stderr is a terminal."""
    monkeypatch.setenv("COLUMNS", "140")
    monkeypatch.setenv("TERM", "xterm")
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    return stream


def test_a_design_shows_stages_time_and_the_solvers_steps(monkeypatch, tmp_path):
    terminal = watch(monkeypatch)
    before = read_steps()
    assert run_command(["design", str(PROBLEMS / "first-steps.yaml"), "-o", str(tmp_path / "out")]) == 0
    shown = terminal.getvalue()
    assert read_steps() > before + 10
    for stage in ("solving distinct runs", "proving the laws", "writing samples and report"):
        assert stage in shown
    assert re.search(r"0:00:0\d", shown)
    assert re.search(r"\d+ solver steps", shown)


def test_steps_are_counted_from_where_progress_begins(monkeypatch):
    terminal = watch(monkeypatch)
    count_steps(7)
    with show_progress() as report:
        report("solving", 1, 3)
        count_steps(5)
    assert "5 solver steps" in terminal.getvalue()
    assert "12 solver steps" not in terminal.getvalue()


@pytest.mark.parametrize("option", ["--no-progress", "--quiet"])
def test_progress_can_be_left_out(monkeypatch, option):
    terminal = watch(monkeypatch)
    assert run_command(["verify", str(LAW), option]) == 0
    shown = terminal.getvalue()
    assert "proving" not in shown
    assert not re.search(r"\x1b\[\?25|\x1b\[\d*[AKJ]", shown)  # no cursor is hidden, no line taken back
    assert ("certified" in shown) == (option == "--no-progress")
    if option == "--quiet":
        assert shown == ""
    assert run_command(["verify", str(LAW)]) == 0
    assert "proving" in terminal.getvalue()


def test_quiet_says_what_is_wrong_all_the_same(capsys, tmp_path):
    document = json.loads(LAW.read_text())
    document["limits"]["jerk"] = 1.0
    path = tmp_path / "law.json"
    path.write_text(json.dumps(document))
    assert run_command(["verify", str(path), "--quiet"]) == 1
    said = capsys.readouterr().err
    assert all(line.startswith("finding: ") for line in said.splitlines())
    assert "jerk reaches" in said
    assert run_command(["verify", os.devnull, "--quiet"]) == 2
    assert capsys.readouterr().err.startswith("timelaw: ")


def test_a_long_tour_is_summed_up_unless_all_is_asked_for(capsys):
    path = str(PROBLEMS / "gimbal-600-cell.yaml")
    assert run_command(["tour", path]) == 0
    short = capsys.readouterr().err
    assert run_command(["tour", path, "--all"]) == 0
    whole = capsys.readouterr().err
    legs = re.compile(r"^ \S+–\S+ .*°?\d", re.M)
    assert len(legs.findall(short)) == 16
    assert len(legs.findall(whole)) == 59
    assert "… 43 more" in short
    assert (
        "59 legs of 72.0000° to 72.0000°, half of them up to 72.0000°; inner nodes: 54 corner, 4 straight"
        in short
    )
    assert "more" not in whole.split("least time")[0]


def test_a_table_lines_up_whatever_its_labels_hold():
    rows = [["1–12", "1.5"], ["東京", "-20"], ["e\u0301", "3"], ["a\nb\x1b[2J", "[red]4[/red]"]]
    lines = format_table(["leg", "value"], rows).splitlines()
    assert lines[1:] == [
        " leg             value",
        " " + "─" * 21,
        " 1–12              1.5",
        " 東京              -20",
        " e\u0301                   3",
        " a b [2J  [red]4[/red]",
    ]
