"""The log of a sweep: whole lines whatever happens, nobody else's file, one sweep at a time."""

import json
import os
from math import inf

import pytest

from tests.sweeps import list_keys, read_entries
from timelaw.errors import Fault, InputError
from timelaw.results_folder import write_results
from timelaw.study.outcome import Outcome, describe_failure, parse_outcome
from timelaw.study.sweep_log import HEAD, NAME, open_log

OUTCOME = Outcome(
    {"limits.jerk": "6 deg/s^3", "easing.degree": 9},
    holds=True,
    duration=0.1 + 0.2,
    to_limit=1 + 2**-52,
    continuity=2,
    efforts={"jerk": 5e-324, "energy": 1e300, "snap": inf},
    peaks={"jerk": 1 - 2**-53},
    easing="polynomial of degree 9",
    status='ω "jumps"\nat a node; …',
)
NONE = Outcome({"limits.jerk": "1e9 deg/s^3"}, status="too early", failure="infeasible")


def fill(folder, outcomes):
    with open_log(folder) as log:
        for key, outcome in outcomes.items():
            log[key] = outcome
    return folder / NAME


def test_outcomes_are_read_back_bit_for_bit(tmp_path):
    fill(tmp_path / "new" / "o", {"a": OUTCOME, "b": NONE})
    with open_log(tmp_path / "new" / "o") as log:
        assert dict(log) == {"a": OUTCOME, "b": NONE}
        assert not log.cut_off
        assert log.unreadable == 0
    assert next(read_entries(tmp_path / "new" / "o" / NAME))["efforts"]["snap"] is None


def test_a_log_cut_off_anywhere_loses_one_line_at_most(tmp_path):
    path = fill(tmp_path, {"a": OUTCOME, "b": NONE})
    whole = path.read_bytes()
    ends = [len(HEAD), whole.index(b"\n", len(HEAD)) + 1, len(whole)]
    near = {end + step for end in ends for step in (-2, -1, 0, 1)}
    for size in sorted({*range(1, len(whole), 13), *near} - {len(whole) + 1}):
        path.write_bytes(whole[:size])
        kept = sum(size >= end for end in ends[1:])
        with open_log(tmp_path) as log:
            assert [*log] == ["a", "b"][:kept]
            assert log.cut_off == (size > len(HEAD) and size not in ends)
            assert log.unreadable == 0
            log["c"] = OUTCOME
        assert list_keys(path) == [*["a", "b"][:kept], "c"]


@pytest.mark.parametrize(
    "line",
    [b"", b"{", b"\0\0\0\0", b"[1]", b'{"key": 1}', b'{"key": "x", "holds": "so so"}', b"\xff", b"[" * 10**5],
)
def test_lines_that_are_no_outcomes_are_counted_and_left(tmp_path, line):
    path = fill(tmp_path, {"a": OUTCOME})
    path.write_bytes(path.read_bytes() + line + b"\n")
    fill(tmp_path, {"b": NONE})
    with open_log(tmp_path) as log:
        assert dict(log) == {"a": OUTCOME, "b": NONE}
        assert log.unreadable == 1
    assert line in path.read_bytes()


def test_of_two_lines_with_one_key_the_first_counts(tmp_path):
    path = fill(tmp_path, {"a": OUTCOME})
    path.write_text(path.read_text() + json.dumps({"key": "a", **NONE.to_dict()}) + "\n")
    with open_log(tmp_path) as log:
        assert log["a"] == OUTCOME


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("my notes\nof a sweep\n", "is not the log of a sweep; move it away"),
        ("my notes", "is not the log of a sweep"),
        ('{"format": "timelaw-sweep-log", "version": 2}\n', "is the log of another version of timelaw"),
    ],
)
def test_nobody_elses_file_is_written_to(tmp_path, content, message):
    (tmp_path / NAME).write_text(content)
    with pytest.raises(InputError, match=message), open_log(tmp_path):
        pytest.fail("it was taken for a log")
    assert (tmp_path / NAME).read_text() == content


def test_what_is_no_file_is_refused(tmp_path):
    os.mkfifo(tmp_path / NAME)
    with pytest.raises(InputError, match="it is no file of at most 200 MB"), open_log(tmp_path):
        pytest.fail("it was opened")
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"), open_log(tmp_path / "file"):
        pytest.fail("it was opened")


def test_two_sweeps_into_one_folder_are_refused(tmp_path):
    with open_log(tmp_path) as log:
        log["a"] = OUTCOME
        with pytest.raises(InputError, match="another sweep is writing it"), open_log(tmp_path):
            pytest.fail("both write")
        write_results(tmp_path, "sweep", {"sweep.csv": "1"})  # which replaces the folder, not the log
        with pytest.raises(InputError, match="another sweep is writing it"), open_log(tmp_path):
            pytest.fail("both write")
        log["b"] = NONE
    with open_log(tmp_path) as log:
        assert [*log] == ["a", "b"]
    assert (tmp_path / "sweep.csv").exists()


def test_where_nothing_came_of_it_there_is_no_trace(tmp_path):
    fill(tmp_path / "results" / "s", {})
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "notes").write_text("mine")
    fill(tmp_path, {})
    assert [path.name for path in tmp_path.iterdir()] == ["notes"]


def test_a_full_disk_leaves_whole_lines(tmp_path, monkeypatch):
    write = os.write
    with open_log(tmp_path) as log:
        log["a"] = OUTCOME
        monkeypatch.setattr(os, "write", lambda descriptor, content: write(descriptor, content[:20]))
        with pytest.raises(InputError, match=r"sweep.jsonl: cannot be written: No space left"):
            log["b"] = NONE
        monkeypatch.undo()
        log["c"] = NONE
    assert list_keys(tmp_path / NAME) == ["a", "c"]


def test_a_failure_tells_no_folder():
    faults = (
        Fault("no such key", "limits.jerk", "home/p.yaml", 3, 4),
        Fault("not a number", "", "home/scan.csv", 7, 1),
    )
    outcome = describe_failure({}, InputError(*faults), "home/p.yaml")
    assert outcome.status == "limits.jerk: no such key; scan.csv:7:1: not a number"
    assert parse_outcome(outcome.to_dict()).failure == "wrong"
