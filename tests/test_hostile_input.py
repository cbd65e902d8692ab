"""Bytes that nobody means well: refused with the place and what is allowed, before they take time or memory."""

import json
import os
import socket
from pathlib import Path

import pytest

from tests.cases import PROBLEMS
from timelaw.cli.app import _run
from timelaw.errors import Fault, InputError
from timelaw.files import MAX_BYTES
from timelaw.law_file import read_law
from timelaw.law_file.read import MOST_PARTS
from timelaw.orientations import angle_files
from timelaw.orientations.aem import read_aem
from timelaw.orientations.angle_files import read_angles
from timelaw.orientations.stk import read_stk
from timelaw.orientations.table import read_table
from timelaw.problem import load_problem, parse_problem
from timelaw.problem.source import read
from timelaw.study.study import read_study

HEAD = "timelaw: 1\nname: scan\nroute: {orientations: {lattice: 24-cell}, tour: paper}\nlimits: {jerk: 9 rad/s^3}\n"
READERS = (load_problem, read_study, read_law, read_table)
ROOT = Path(__file__).parent.parent


def chain(links: int, inner: str) -> str:
    """Anchors that each stand for ten times as much as the one before."""
    return "a0: &a0 {x: 1}\n" + "".join(
        f"a{i}: &a{i} {inner.format(', '.join([f'*a{i - 1}'] * 10))}\n" for i in range(1, links)
    )


YAML = {
    "merge keys": (HEAD + chain(9, "{{<<: [{}]}}"), "6:10: not readable as YAML: a merge key (<<); write the keys that it stands for out here"),
    "aliases": (HEAD + chain(9, "[{}]"), "10:20: not readable as YAML: more than 100000 keys and values; orientations may stand in a table (file: …)"),
    "deep aliases": ("a0: &a0 [1]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}]\n" for i in range(1, 999)), "49:12: not readable as YAML: nested too deeply; 50 lists and mappings inside each other are allowed"),
    "brackets": ("[" * (MAX_BYTES - 1), "1:51: not readable as YAML: nested too deeply; 50 lists and mappings inside each other are allowed"),
    "dashes": ("- " * (MAX_BYTES // 2 - 1), "1:101: not readable as YAML: nested too deeply; 50 lists and mappings inside each other are allowed"),
    "400 digits": (HEAD + f"nodes: {{continuity: {'9' * 400}}}", "5:21: nodes.continuity: a whole number of more than 300 digits; none here is that large"),
    "a million digits": (HEAD + f"nodes: {{continuity: {'9' * 1_000_000}}}", "5:21: nodes.continuity: a whole number of more than 300 digits; none here is that large"),
    "hexadecimal digits": (HEAD + f"x: [1, 0x{'f' * 400}]", "5:8: x[2]: a whole number of more than 300 digits; none here is that large"),
    "digits as key": (HEAD + f"{'9' * 400}: 1", f"5:1: {'9' * 400}: a whole number of more than 300 digits; none here is that large"),
    "no digits": (HEAD + "x: -_", '5:4: not readable as YAML: "-_" is no number; a text that looks like one stands in quotes'),
    "tag": (HEAD + "x: !!python/object:os.system ls", "5:4: not readable as YAML: a tag (!…); none is needed: a text stands in quotes, a number without"),
    "long tag": (HEAD + "x: !" + "y" * 1_000_000, "5:4: not readable as YAML: a tag (!…); none is needed: a text stands in quotes, a number without"),
    "NUL": (HEAD + "x: \0", "5:4: not readable as YAML: the character #x0000 is not allowed"),
    "half a character": (HEAD + 'x: "\\ud800"', "5:4: not readable as YAML: half a surrogate pair is no character; write the character itself"),
    "no character": (HEAD + 'x: "\\UFFFFFFFF"', "5:7: not readable as YAML: an escape or directive here has a number that is out of range"),
    "other version": ("%YAML 1.1\n---\n" + HEAD, "2:1: not readable as YAML: YAML 1.2 is read, no other version"),
    "duplicate key": (HEAD + "name: scan", '5:1: duplicate key "name"'),
    "a long value": (HEAD + "nodes: {continuity: " + "x" * 5000 + "}", f'5:21: nodes.continuity: "{"x" * 500}… (5000 characters)"; allowed: 1, 2, 3, 4'),
    "blanks in a quantity": (HEAD.replace("9 rad/s^3", '"9' + " " * 300_000 + 'x"'), '4:16: limits.jerk: "9' + " " * 499 + '… (300002 characters)" is not an angular jerk; write it like "600 deg/s^3"'),
}  # fmt: skip


@pytest.mark.parametrize("case", YAML)
def test_yaml_that_is_refused(case):
    text, message = YAML[case]
    with pytest.raises(InputError) as error:
        parse_problem(text, "scan.yaml")
    assert str(error.value).startswith(f"scan.yaml:{message}")
    assert len(error.value.faults) == 1


def test_a_hundred_faults_are_listed():
    with pytest.raises(InputError) as error:
        parse_problem(HEAD + "".join(f"u{i}: 1\n" for i in range(3000)), "scan.yaml")
    assert len(error.value.faults) == 101
    assert str(error.value.faults[-1]) == "scan.yaml: 2900 more faults"


def test_aliases_and_dates_work_as_they_look():
    """An alias may stand for a part as often as it is written; a name may be given again; dates are labels."""
    text = (
        HEAD
        + "nodes:\n  at:\n    2024-01-01: &a {dwell: 1 s}\n    2024-02-30: *a\n    c: &a {stop: true}\n    d: *a\n"
    )
    nodes = parse_problem(text).nodes.at
    assert list(nodes) == ["2024-01-01", "2024-02-30", "c", "d"]
    assert nodes["2024-02-30"].dwell == 1
    assert nodes["d"].stop


@pytest.mark.parametrize("label", ["x[y[1]", "a[99999999999999999999]", "[", "[1]", "a.b[2]c", "."])
def test_a_label_like_a_path_has_a_place(label):
    source = read(HEAD + f'nodes: {{at: {{"{label}": {{dwell: 1 s}}}}}}\n', "scan.yaml")
    with pytest.raises(InputError) as error, source.placed():
        raise InputError(Fault("no such node", f"nodes.at.{label}"))
    assert str(error.value).startswith("scan.yaml:5:")
    assert str(error.value).endswith(f"nodes.at.{label}: no such node")


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("encoding", ["utf-16", "utf-32", "utf-16-be"])
def test_other_encodings(tmp_path, reader, encoding):
    path = tmp_path / "input"
    path.write_bytes((HEAD + "# ü\n").encode(encoding))
    with pytest.raises(InputError) as error:
        reader(path)
    assert str(path) in str(error.value)
    assert error.value.exit_code == 2


@pytest.mark.parametrize("reader", READERS)
def test_what_is_no_regular_file(tmp_path, reader, monkeypatch):
    os.mkfifo(tmp_path / "pipe")
    with socket.socket(socket.AF_UNIX) as ear:
        monkeypatch.chdir(tmp_path)  # names of sockets are short
        ear.bind("socket")
        kinds = {tmp_path / "pipe": "a pipe", tmp_path / "socket": "a socket", Path("/dev/zero"): "a device", Path("/dev/null"): "a device"}  # fmt: skip
        for path, kind in kinds.items():
            with pytest.raises(InputError) as error:
                reader(path)
            assert str(error.value) == f"{path}: cannot be read: it is {kind}; a regular file is needed"
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        reader(tmp_path)
    with pytest.raises(InputError, match="cannot be read: "):
        reader(Path("a\0b"))
    with pytest.raises(InputError, match="cannot be read: File name too long"):
        reader(tmp_path / ("x" * 5000))


def test_files_that_problems_and_studies_name(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    problem = tmp_path / "p.yaml"
    problem.write_text(HEAD.replace("lattice: 24-cell", "file: pipe.csv").replace(", tour: paper", ""))
    assert _run(["tour", str(problem)]) == 2
    (tmp_path / "s.yaml").write_text(
        "timelaw-study: 1\nname: s\nproblem: /dev/zero\nvary: {limits.jerk: [9 rad/s^3]}\n"
    )
    with pytest.raises(InputError, match="/dev/zero: cannot be read: it is a device"):
        read_study(tmp_path / "s.yaml")


@pytest.mark.parametrize(
    ("reader", "name", "most"), [(load_problem, "p.yaml", 2), (read_study, "s.yaml", 2), (read_law, "l.json", 50), (read_table, "t.csv", 50), (read_angles, "a.ang", 500), (read_aem, "a.aem", 50), (read_stk, "a.a", 50)]
)  # fmt: skip
def test_files_that_are_too_large_are_not_opened(tmp_path, reader, name, most):
    path = tmp_path / name
    with path.open("wb") as file:
        file.truncate(10**11)
    with pytest.raises(InputError) as error:
        reader(path)
    assert str(error.value) == f"{path}: larger than {most} MB, which is the most allowed"


TABLES = {
    "lines": ("w,x,y,z\n" + "1,0,0,0\n" * 500_000, ": 500001 lines; at most 500000 are allowed"),
    "carriage returns": ("w,x,y,z\n" + "\r" * 500_001, ": 500001 lines; at most 500000 are allowed"),
    "cells": ("w,x,y,z\n1,0,0,0" + "," * 5_000_000, ": 5000008 cells; at most 5000000 are allowed"),
    "columns": (",".join(f"c{i}" for i in range(2000)), ": 2000 columns; at most 1000 are allowed"),
    "a long label": ("label,w,x,y,z\n" + "a" * 1001 + ",1,0,0,0\nb,0,1,0,0\n", ":2:1: a label of 1001 characters; at most 1000 are allowed"),
    "a long number": ("w,x,y,z\n" + "1" * 100_000 + ",0,0,0\n", f':2:1: "{"1" * 500}… (100000 characters)" is out of range; 1e+09 at most is allowed'),
    "a long cell": ("w,x,y,z\n" + "1" * 200_000 + ",0,0,0\n", ":2:1: not readable as CSV: field larger than field limit (131072)"),
    "NUL": ("w,x,y,z\n\0,0,0,0\n", ':2:1: "\0" is not a number'),
}  # fmt: skip


@pytest.mark.parametrize("case", TABLES)
def test_tables(tmp_path, case):
    content, message = TABLES[case]
    path = tmp_path / "scan.csv"
    path.write_text(content, newline="")
    with pytest.raises(InputError) as error:
        read_table(path)
    assert str(error.value) == f"{path}{message}"


def test_angle_files_of_too_many_points(tmp_path, monkeypatch):
    monkeypatch.setattr(angle_files, "MOST_POINTS", 1000)
    names = "Phase\tEuler1\tEuler2\tEuler3\n"
    for name, text in (("a.ang", "1 2 3\n" * 1001), ("a.ctf", names + "1\t2\t3\t4\n" * 1001)):
        (tmp_path / name).write_text(text)
        with pytest.raises(InputError, match=r":100[12]:1: more than 1000 points; choose a phase"):
            read_angles(tmp_path / name)


def test_a_line_without_an_end_is_not_held(tmp_path):
    readers = {"a.ang": read_angles, "a.ctf": read_angles, "a.aem": read_aem, "a.a": read_stk}
    for name, reader in readers.items():
        (tmp_path / name).write_text("stk.v.1\n" + "1" * 10_000_000)
        with pytest.raises(InputError):
            reader(tmp_path / name)


def law(**changes) -> str:
    document = json.loads((ROOT / "tests/fuzz/corpus/law/polynomial.json").read_text())
    return json.dumps(document | changes)


SEGMENT = next(segment for segment in json.loads(law())["segments"] if segment["kind"] == "arc")
LAWS = {
    "brackets": ("[" * 1_000_000, ": not readable as JSON: nested too deeply"),
    "values": ("[" + "0," * MOST_PARTS + "0]", f": {MOST_PARTS + 1} values; at most {MOST_PARTS} are allowed"),
    "digits": ('{"a": 1' + "0" * 5000 + "}", f": not readable as JSON: 1{'0' * 499}… (5001 characters) is not a finite number"),
    "duplicate key": ('{"a": 1, "b": 2, "b": 3}', ': not readable as JSON: duplicate key "b"'),
    "segments": (law(segments=[0] * 100_000), ": segments[0]: Input should be a valid dictionary or object to extract fields from"),
    "pieces": (law(segments=[SEGMENT | {"pieces": [0] * 100_000}]), ": segments[0].pieces[0]: Input should be a valid dictionary or instance of PieceDocument"),
    "limits": (law(limits={f"k{i}": 0 for i in range(100_000)}), ": limits: Value error, 100000 keys; at most 100 are allowed"),
    "conventions": (law(conventions={f"k{i}": "" for i in range(101)}), ": conventions: Value error, 101 keys; at most 100 are allowed"),
    "half a character": (law(name="\ud800"), ": name: Input should be a valid string, unable to parse raw data as a unicode string"),
    "a long label": (law(name="x" * 1001), ": name: String should have at most 1000 characters"),
    "NUL": (law() + "\0", ":1:"),
}  # fmt: skip


@pytest.mark.parametrize("case", LAWS)
def test_laws(tmp_path, case, capsys):
    content, message = LAWS[case]
    path = tmp_path / "law.json"
    path.write_text(content)
    with pytest.raises(InputError) as error:
        read_law(path)
    assert str(error.value).startswith(f"{path}{message}")
    assert len(error.value.faults) == 1
    assert _run(["verify", str(path), "--json"]) == 2
    assert json.loads(capsys.readouterr().out)["exit_code"] == 2


def test_unreadable_files(tmp_path):
    path = tmp_path / "p.yaml"
    path.write_text(HEAD)
    path.chmod(0)
    if os.access(path, os.R_OK):
        pytest.skip("this user may read everything")
    with pytest.raises(InputError, match="cannot be read: Permission denied"):
        load_problem(path)


def test_shipped_problems_are_read():
    for path in PROBLEMS.glob("*.yaml"):
        assert load_problem(path)[0].name == path.stem
