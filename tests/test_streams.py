"""Closed, full and cut-off streams: the work is done, its exit code told, and nothing else is said."""

import json
import os
import shlex
import subprocess
import sys

import pytest

from tests.cases import PROBLEMS

LAW = PROBLEMS.parent / "results" / "paper-24-cell" / "law.json"
COMMAND = shlex.join([sys.executable, "-m", "timelaw", "verify", str(LAW), "--json"])
NOISE = ("Traceback", "Exception", "Error")
FULL = pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no /dev/full here")


def shell(text):
    """What bash says of a line, by its exit code, stdout and stderr."""
    return subprocess.run(["bash", "-c", text], capture_output=True, text=True, check=False, timeout=120)


@pytest.mark.parametrize(
    "redirection",
    [
        ">&-",
        "2>&-",
        "<&- >&- 2>&-",
        pytest.param(">/dev/full", marks=FULL),
        pytest.param("2>/dev/full", marks=FULL),
        "| head -1",
        "2>&1 | true",
    ],
)
def test_the_exit_code_is_that_of_the_work(redirection):
    done = shell(f"{COMMAND} {redirection}; exit ${{PIPESTATUS[0]}}")
    assert done.returncode == 0
    assert not [word for word in NOISE if word in done.stderr]
    if redirection == "2>&-":
        assert json.loads(done.stdout)["ok"] is True


@pytest.mark.parametrize("redirection", [">&-", pytest.param(">/dev/full", marks=FULL)])
def test_errors_have_their_exit_code_too(redirection):
    done = shell(
        f"{shlex.join([sys.executable, '-m', 'timelaw', 'verify', 'none.json', '--json'])} {redirection}"
    )
    assert done.returncode == 2
    assert done.stderr == "timelaw: none.json: cannot be read: No such file or directory\n"


def test_files_are_not_taken_for_closed_streams(tmp_path):
    """What goes to closed streams must not end up in files that are opened instead of them."""
    problem = tmp_path / "p.yaml"
    problem.write_text((PROBLEMS / "first-steps.yaml").read_text())
    out = tmp_path / "tour.csv"
    command = shlex.join([sys.executable, "-m", "timelaw", "tour", str(problem), "-o", str(out), "--json"])
    assert shell(command).returncode == 0
    expected = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert len(expected) == 3
    assert shell(f"{command} <&- >&- 2>&-").returncode == 0
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == expected


def test_what_a_stream_cannot_spell_is_spelt_out():
    environment = os.environ | {"PYTHONIOENCODING": "ascii"}
    command = [sys.executable, "-m", "timelaw", "verify", str(LAW)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, timeout=120)
    assert done.returncode == 0
    assert "\\u" in done.stderr
    assert "certified" in done.stderr
