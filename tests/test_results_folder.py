"""Results appear whole or not at all, whatever stands in the folder, and whatever breaks."""

import errno
import json
import os
from pathlib import Path

import pytest

from timelaw.errors import InputError
from timelaw.results_folder import repair_results, write, write_results
from timelaw.results_folder.locks import hold_new
from timelaw.results_folder.manifest import MANIFEST
from timelaw.results_folder.names import LOCK, list_beside, list_inside, make_beside, make_inside
from timelaw.results_folder.one_by_one import write_journal

OLD = {"law.json": "old law", "samples.csv": "old samples", "rates.svg": "old"}
NEW = {"law.json": "new law", "report.html": "new report"}


def contents(folder: Path) -> dict[str, str]:
    """Everything in a folder but the manifest."""
    files = (path for path in sorted(folder.rglob("*")) if path.is_file() and path.name != MANIFEST)
    return {str(path.relative_to(folder)): path.read_text() for path in files}


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def folder(tmp_path):
    write_results(tmp_path / "out", "design", OLD)
    return tmp_path / "out"


WAYS = pytest.mark.usefixtures("way")


@pytest.fixture(params=["exchange", "two steps", "inside"])
def way(request, monkeypatch):
    """The three ways of replacing a folder."""
    if request.param == "two steps":
        monkeypatch.setattr(write, "swap_folders", lambda *_: False)
    elif request.param == "inside":
        monkeypatch.setattr(write, "_is_replaceable", lambda _: False)
    return request.param


@WAYS
def test_new_results_take_the_place_of_all_old_ones(folder):
    write_results(folder, "design", NEW)
    assert contents(folder) == NEW
    assert names(folder) == sorted([MANIFEST, *NEW])
    assert names(folder.parent) == ["out"]


@WAYS
def test_what_is_not_ours_stays(folder):
    (folder / "notes.txt").write_text("mine")
    (folder / "sub" / "deep").mkdir(parents=True)
    (folder / "sub" / "deep" / "law.json").write_text("mine too")
    (folder / "link").symlink_to("nowhere")
    write_results(folder, "design", NEW)
    assert contents(folder) == NEW | {"notes.txt": "mine", "sub/deep/law.json": "mine too"}
    assert os.readlink(folder / "link") == "nowhere"
    assert names(folder.parent) == ["out"]


@WAYS
def test_results_of_other_commands_stay(folder):
    write_results(folder, "sweep", {"sweep.csv": "1", "front.svg": "1"})
    assert contents(folder) == OLD | {"sweep.csv": "1", "front.svg": "1"}
    write_results(folder, "design", NEW)
    write_results(folder, "sweep", {"sweep.csv": "2"})
    assert contents(folder) == NEW | {"sweep.csv": "2"}
    assert json.loads((folder / MANIFEST).read_text()) == {"design": [*NEW], "sweep": ["sweep.csv"]}


@pytest.mark.parametrize("said", [None, "{", "[]", '{"design": 3}', '{"design": ["../x", "/etc/x", 3]}'])
def test_results_without_a_manifest_are_known_by_their_names(tmp_path, folder, said):
    (tmp_path / "x").write_text("outside")
    (folder / MANIFEST).unlink()
    if said is not None:
        (folder / MANIFEST).write_text(said)
    write_results(folder, "design", NEW)
    assert NEW.items() <= contents(folder).items()
    assert (tmp_path / "x").read_text() == "outside"
    assert "samples.csv" not in contents(folder) or "/etc" in said


def test_a_link_to_a_folder_stays_a_link(tmp_path, folder):
    (tmp_path / "link").symlink_to("out")
    write_results(tmp_path / "link", "design", NEW)
    assert (tmp_path / "link").is_symlink()
    assert contents(folder) == NEW


@pytest.mark.parametrize("place", [".", "..", "../../a/b"])
def test_the_working_folder_is_written_into(tmp_path, monkeypatch, place):
    (tmp_path / "a" / "b").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "a" / "b")
    write_results(Path(place), "design", OLD)
    write_results(Path(place), "design", NEW)
    assert NEW.items() <= contents(Path(place)).items()
    assert Path.cwd().exists()


def test_rights_of_the_folder_stay(folder):
    folder.chmod(0o750)
    write_results(folder, "design", NEW)
    assert folder.stat().st_mode & 0o777 == 0o750


def test_new_folders_and_files_have_the_usual_rights(tmp_path):
    mask = os.umask(0o027)
    try:
        write_results(tmp_path / "new" / "out", "design", NEW)
    finally:
        os.umask(mask)
    assert (tmp_path / "new" / "out").stat().st_mode & 0o777 == 0o750
    assert (tmp_path / "new" / "out" / "law.json").stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("taken", ["", "out/law.json", "a/b"])
def test_what_stands_in_the_way_is_said(tmp_path, taken):
    if taken == "a/b":
        (tmp_path / "a").write_text("")
        place, reason = tmp_path / "a" / "b", "Not a directory"
    elif taken:
        (tmp_path / taken).mkdir(parents=True)
        place, reason = tmp_path / "out", "Is a directory"
    else:
        place, reason = tmp_path / "out", "Not a directory"
        place.write_text("")
    with pytest.raises(InputError, match=f"cannot be written: {reason}"):
        write_results(place, "design", NEW)
    assert not [name for name in names(tmp_path) if name.startswith(".")]


@pytest.mark.parametrize("after", range(5))
def test_a_full_disk_leaves_the_old_results(folder, monkeypatch, after):
    """Whatever cannot be written any more: each file, the manifest."""
    left = iter(range(after))

    def fsync(_):
        if next(left, None) is None:
            raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", fsync)
    if after >= len(NEW):
        monkeypatch.setattr(write, "format_manifest", lambda *_: fsync(0) or fsync(0) or fsync(0) or fsync(0))
    with pytest.raises(InputError, match="cannot be written: No space left on device"):
        write_results(folder, "design", NEW)
    assert contents(folder) == OLD
    assert names(folder.parent) == ["out"]


@WAYS
def test_an_interrupt_while_writing_leaves_the_old_results(folder, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_results(folder, "design", NEW)
    assert contents(folder) == OLD
    assert names(folder.parent) == ["out"]
    assert not list_inside(folder)


class Killed(BaseException):
    """As if the process ended here: nothing is tidied up any more."""


@pytest.mark.parametrize("step", range(1, 16))
def test_killed_at_any_step_old_or_new_is_left_and_the_next_run_repairs(folder, way, monkeypatch, step):
    """Each system call that changes something may be the last one."""
    (folder / "notes.txt").write_text("mine")
    mine = {"notes.txt": "mine"}
    left = [step]

    def until(call):
        def counted(*arguments, **named):
            if left[0] <= 0:
                raise Killed
            left[0] -= 1
            return call(*arguments, **named)

        return counted

    with monkeypatch.context() as patch:
        for name in ("link", "rename", "unlink", "replace", "fsync", "mkdir", "rmdir"):
            patch.setattr(os, name, until(getattr(os, name)))
        patch.setattr(write, "swap_folders", until(write.swap_folders))
        patch.setattr(write, "write_journal", until(write_journal))
        try:
            write_results(folder, "design", NEW)
        except Killed:
            if way != "inside" and folder.exists():
                assert contents(folder) in (OLD | mine, NEW | mine)
    repair_results(folder)
    assert contents(folder) in (OLD | mine, NEW | mine)
    assert names(folder.parent) == ["out"]
    write_results(folder, "design", NEW)
    assert contents(folder) == NEW | mine


def test_what_a_living_run_is_writing_is_left_alone(folder):
    beside, inside = make_beside(folder), make_inside(folder)
    dead = make_beside(folder)
    (dead / LOCK).write_text("")
    (dead / "law.json").write_text("half a l")
    with hold_new(beside / LOCK), hold_new(inside / LOCK):
        repair_results(folder)
        assert list_beside(folder) == [beside]
        write_results(folder, "design", NEW)
        assert list_beside(folder) == [beside]
        assert list_inside(folder) == [inside]
    repair_results(folder)
    assert names(folder.parent) == ["out"]
    assert contents(folder) == NEW


def test_other_folders_of_like_names_are_left_alone(tmp_path, folder):
    kept = [
        ".out.timelaw",
        ".out.x.timelaw",
        ".out.b.abcdefgh.timelaw",
        ".outabcdefgh.timelaw",
        "abcdefgh.timelaw",
    ]
    for name in kept:
        (tmp_path / name).mkdir()
    (tmp_path / ".out.abcdefgh.timelaw").write_text("a file")
    repair_results(folder)
    assert names(tmp_path) == sorted([*kept, "out", ".out.abcdefgh.timelaw"])


def test_what_is_saved_removed_or_made_while_the_folder_is_replaced(folder, monkeypatch):
    for name in ("saved", "removed", "kept"):
        (folder / name).write_text("before")
    swap = write.swap_folders

    def late(staging, place):
        (place / "draft").write_text("after")
        os.replace(place / "draft", place / "saved")
        (place / "removed").unlink()
        (place / "made").write_text("after")
        return swap(staging, place)

    monkeypatch.setattr(write, "swap_folders", late)
    write_results(folder, "design", NEW)
    assert contents(folder) == NEW | {"saved": "after", "kept": "before", "made": "after"}


def test_too_many_other_files_are_not_linked(folder, monkeypatch):
    monkeypatch.setattr("timelaw.results_folder.carry.MOST_LINKED", 3)
    for k in range(5):
        (folder / f"{k}.txt").write_text("mine")
    write_results(folder, "design", NEW)
    assert contents(folder) == NEW | {f"{k}.txt": "mine" for k in range(5)}
    assert names(folder.parent) == ["out"]
