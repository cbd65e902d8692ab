"""No space left: exit code 2 with the reason, the old results as they were, nothing beside them."""

import json
import os
import resource
import subprocess
import sys
import threading

import pytest

from tests.cases import PROBLEMS
from timelaw.errors import InputError
from timelaw.files import write_files
from timelaw.results_folder import write_results

SMALL, LARGE = "s" * 20_000, "l" * 200_000
SIZE = "size=256k"


@pytest.fixture
def disk(tmp_path):
    """A file system of a quarter of a megabyte."""
    place = tmp_path / "disk"
    place.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", SIZE, "tmpfs", str(place)]
    try:
        subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("file systems cannot be mounted here")
    yield place
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.parametrize("inside", [False, True])
def test_a_disk_that_is_full(disk, monkeypatch, inside):
    if inside:
        monkeypatch.setattr("timelaw.results_folder.write._is_replaceable", lambda _: False)
    write_results(disk / "out", "design", {"law.json": SMALL, "samples.csv": SMALL})
    before = {path.name: path.read_bytes() for path in (disk / "out").iterdir()}
    with pytest.raises(InputError, match=r"cannot be written: No space left on device"):
        write_results(disk / "out", "design", {"law.json": LARGE, "samples.csv": LARGE})
    assert {path.name: path.read_bytes() for path in (disk / "out").iterdir()} == before
    assert [path.name for path in disk.iterdir()] == ["out"]
    write_results(disk / "out", "design", {"law.json": SMALL[1:]})


def test_two_files_of_which_only_one_finds_room(disk):
    one, other = disk / "tour.csv", disk / "tour.svg"
    write_files({one: "old", other: "old"})
    with pytest.raises(InputError, match=r"tour.svg: cannot be written: No space left on device"):
        write_files({one: SMALL, other: LARGE + LARGE})
    assert [path.read_text() for path in (one, other)] == ["old", "old"]
    assert sorted(disk.iterdir()) == [one, other]


def test_files_that_may_not_grow(tmp_path):
    """As a quota stops them: samples.csv has 94 kB."""
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "law.json").write_text("old")

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

    problem = PROBLEMS / "first-steps.yaml"
    command = [sys.executable, "-m", "timelaw", "design", str(problem), "-o", "out", "--json"]
    done = subprocess.run(
        command, cwd=tmp_path, preexec_fn=limit, capture_output=True, text=True, check=False, timeout=300
    )
    assert done.returncode == 2
    message = f"cannot be written: {os.strerror(27)}"
    assert json.loads(done.stdout)["errors"][0] == {
        "message": message, "where": "", "path": "out/samples.csv", "line": None, "column": None
    }  # fmt: skip
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert {path.name: path.read_text() for path in (tmp_path / "out").iterdir()} == {"law.json": "old"}


def test_several_runs_into_one_folder_at_once(tmp_path):
    """Whichever is last, its results are there, whole."""
    folder = tmp_path / "out"
    kinds = [{f"{k}.txt": str(run) * 1000 for k in range(run + 1)} for run in range(4)]

    def write(run):
        for _ in range(10):
            write_results(folder, "design", kinds[run])

    runs = [threading.Thread(target=write, args=(run,)) for run in range(4)]
    for thread in runs:
        thread.start()
    for thread in runs:
        thread.join()
    found = {path.name: path.read_text() for path in folder.iterdir() if path.suffix == ".txt"}
    assert found in kinds
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
