"""Malformed problem files: every fault with its place, what was given and what is allowed."""

import pytest

from timelaw.errors import InputError
from timelaw.problem import load_problem, parse_problem

GOOD = """\
timelaw: 1
name: scan
route:
  orientations: {lattice: 24-cell}
  tour: paper
limits:
  velocity: 60 deg/s
"""
KEYS = "timelaw, name, route, body, limits, nodes, motion, segments, easing, objective, baselines, output"
LIMITS = "velocity, acceleration, jerk, snap, torque, momentum, linear_velocity, linear_acceleration"
LATTICES = "16-cell, tesseract, 24-cell, 600-cell, 120-cell"


def replaced(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new)


CASES = {
    # Not YAML, or not a problem at all
    "empty": ("", '1:1: an empty file; a problem file is a mapping that starts with "timelaw: 1"'),
    "a list": ("[1, 2]", '1:1: a list; a problem file is a mapping that starts with "timelaw: 1"'),
    "a word": ("hello", '1:1: a single value; a problem file is a mapping that starts with "timelaw: 1"'),
    "unclosed": (GOOD + "nodes: {continuity: 2", "8:22: not readable as YAML: while parsing a flow mapping expected ',' or '}', but got '<stream end>'"),
    "tab": (GOOD + "nodes:\n\tcontinuity: 2\n", "9:1: not readable as YAML: while scanning for the next token found character '\\t' that cannot start any token"),
    "recursive alias": ("timelaw: &a [*a]", "1:14: not readable as YAML: an alias repeats the part it stands in"),
    "undefined alias": ("timelaw: *a", "1:10: not readable as YAML: found undefined alias 'a'"),
    "two documents": (GOOD + "---\na: 1\n", "8:1: not readable as YAML: expected a single document in the stream but found another document"),
    "alias bomb": ("a0: &a0 [x, x]\n" + "".join(f"a{i}: &a{i} [*a{i - 1}, *a{i - 1}]\n" for i in range(1, 31)), "15:18: not readable as YAML: more than 100000 keys and values; orientations may stand in a table (file: …)"),
    "a list as key": ("? [a, b]\n: 1\n", "1:3: not readable as YAML: a key must be a text"),
    "deep": ("a: " + "[" * 3000 + "]" * 3000, "1:53: not readable as YAML: nested too deeply; 50 lists and mappings inside each other are allowed"),
    "odd tag": ("a: !!bool x", "1:4: not readable as YAML: a tag (!…); none is needed: a text stands in quotes, a number without"),
    "mixed duplicate": (GOOD + "nodes:\n  at:\n    7: {stop: true}\n    \"7\": {stop: true}\n", '11:5: duplicate key "7"'),
    "huge exponent": (replaced("60 deg/s", "60 deg/s*h^99"), '7:13: limits.velocity: cannot read the unit "deg/s*h^99"; write units like "deg/s^2" or "kg*m^2"'),
    "huge quaternion": (replaced("{lattice: 24-cell}", "{list: [[1, 0, 0, 0], [1e200, 0, 0, 0]]}"), "4:39: route.orientations.list[2]: expected a list of numbers, as in [1, 0, 0, 0]"),
    # Keys
    "duplicate key": (GOOD + "name: again\n", '8:1: duplicate key "name"'),
    "duplicate limit": (GOOD + "  velocity: 1 deg/s\n", '8:3: duplicate key "velocity"'),
    "unknown key": (GOOD + "limit: 3\n", f'8:1: unknown key "limit"; allowed: {KEYS}; did you mean "limits"?'),
    "unknown limit": (GOOD + "  velocty: 3 deg/s\n", f'8:3: limits: unknown key "velocty"; allowed: {LIMITS}; did you mean "velocity"?'),
    "unknown, nothing near": (GOOD + "  xyz: 3\n", f'8:3: limits: unknown key "xyz"; allowed: {LIMITS}'),
    "a key that is no text": (GOOD + "1: 2\n", f'8:1: unknown key "1"; allowed: {KEYS}'),
    "missing version": (replaced("timelaw: 1\n", ""), '1:1: missing key "timelaw"'),
    "missing route": ("timelaw: 1\nname: a\nlimits: {jerk: 1 rad/s^3}\n", '1:1: missing key "route"'),
    "missing orientations": (replaced("  orientations: {lattice: 24-cell}\n", ""), '4:3: route: missing key "orientations"'),
    # Values
    "version": (replaced("timelaw: 1", "timelaw: 2"), "1:10: timelaw: 2; this program reads problem files of version 1"),
    "version as text": (replaced("timelaw: 1", 'timelaw: "1"'), '1:10: timelaw: "1"; this program reads problem files of version 1'),
    "name with a slash": (replaced("scan", "../scan"), "2:7: name: \"../scan\"; letters, digits, '.', '_' and '-' are allowed, a letter or digit first"),
    "name is a number": (replaced("scan", "24"), "2:7: name: 24; a text is needed"),
    "lattice": (replaced("24-cell", "25-cell"), f'4:27: route.orientations.lattice: "25-cell"; allowed: {LATTICES}; did you mean "24-cell"?'),
    "two sources": (replaced("24-cell}", "24-cell, file: a.csv}"), '4:17: route.orientations: give exactly one of "lattice", "file", "list", "uniform"'),
    "no source": (replaced("{lattice: 24-cell}", "{}"), '4:17: route.orientations: give exactly one of "lattice", "file", "list", "uniform"'),
    "orientations as text": (replaced("{lattice: 24-cell}", "24-cell"), '4:17: route.orientations: "24-cell"; a mapping of keys and values is needed'),
    "not a number": (replaced("{lattice: 24-cell}", "{list: [[1, 0, 0, 0], [.nan, 1, 0, 0]]}"), "4:39: route.orientations.list[2]: expected a list of numbers, as in [1, 0, 0, 0]"),
    "one orientation": (replaced("{lattice: 24-cell}", "{list: [[1, 0, 0, 0]]}"), "4:17: route.orientations: a list needs at least two orientations"),
    "tour": (replaced("paper", "papr"), '5:9: route.tour: "papr"; allowed: paper, shortest, fewest-stops, least-turning, fastest, given, or a list of labels; did you mean "paper"?'),
    "tour of one": (replaced("paper", "[1]"), "5:9: route.tour: a tour needs at least two labels"),
    "tour label": (replaced("paper", "[1, 2.5]"), "5:9: route.tour: a label is a number or a text, not 2.5; a text may need quotes"),
    "closed": (replaced("paper", "paper\n  closed: yes"), '6:11: route.closed: "yes"; allowed: true, false'),
    "no limits": (replaced("\n  velocity: 60 deg/s", " {}"), f"6:9: limits: at least one of {LIMITS} must be given"),
    "bare number": (replaced("60 deg/s", "60"), '7:13: limits.velocity: "60" has no unit; write an angular velocity like "60 deg/s"'),
    "wrong dimension": (replaced("60 deg/s", "60 deg/s^2"), '7:13: limits.velocity: "60 deg/s^2" is not an angular velocity; write it like "60 deg/s"'),
    "a frequency is no velocity": (replaced("60 deg/s", "60 Hz"), '7:13: limits.velocity: "60 Hz" is not an angular velocity; write it like "60 deg/s"'),
    "unknown unit": (replaced("60 deg/s", "60 degs/s"), '7:13: limits.velocity: unknown unit "degs"; known: rad, mrad, deg, °, arcmin, arcsec, rev, rpm, s, ms, min, h, Hz, kHz, m, cm, mm, kg, g, N, mN, degrees, radians, dps, sec, Nm, mNm, Nms, mNms'),
    "unreadable unit": (replaced("60 deg/s", "60 deg//s"), '7:13: limits.velocity: cannot read the unit "deg//s"; write units like "deg/s^2" or "kg*m^2"'),
    "no number": (replaced("60 deg/s", "fast"), '7:13: limits.velocity: "fast" is not an angular velocity; write it like "60 deg/s"'),
    "negative limit": (replaced("60 deg/s", "-60 deg/s"), '7:13: limits.velocity: "-60 deg/s" is out of range; 1e-09 to 1e+09 rad/s are allowed'),
    "zero limit": (replaced("60 deg/s", "0 deg/s"), '7:13: limits.velocity: "0 deg/s" is out of range; 1e-09 to 1e+09 rad/s are allowed'),
    "huge limit": (replaced("60 deg/s", "1e300 deg/s"), '7:13: limits.velocity: "1e300 deg/s" is out of range; 1e-09 to 1e+09 rad/s are allowed'),
    "limit as list": (replaced("60 deg/s", "[60 deg/s]"), '7:13: limits.velocity: 1 values; one for the norm or three for the body axes are needed'),
    "continuity": (GOOD + "nodes: {continuity: 5}\n", "8:21: nodes.continuity: 5; allowed: 1, 2, 3, 4"),
    "nodes as number": (GOOD + "nodes: 2\n", "8:8: nodes: 2; a mapping of keys and values is needed"),
    "basis": (GOOD + "easing: {basis: polynomal}\n", '8:17: easing.basis: "polynomal"; allowed: polynomial, spline, double-s, auto; did you mean "polynomial"?'),
    "degree too low": (GOOD + "easing: {degree: 4}\n", "8:18: easing.degree: 4; a polynomial has a degree of 5 to 31"),
    "degree too high": (GOOD + "easing: {degree: 32}\n", "8:18: easing.degree: 32; at most 31 is allowed"),
    "degree not whole": (GOOD + "easing: {degree: 9.5}\n", "8:18: easing.degree: 9.5; a whole number is needed"),
    "too few intervals": (GOOD + "nodes: {continuity: 4}\neasing: {basis: spline, degree: 5, intervals: 4}\n", "9:47: easing.intervals: 4; continuity 4 at the nodes needs 5 or more, or a higher degree"),
    "too few intervals for the degree that suits": (GOOD + "nodes: {continuity: 4}\neasing: {basis: spline, intervals: 3}\n", "9:36: easing.intervals: 3; continuity 4 at the nodes needs 4 or more, or a higher degree"),
    "degree for continuity": (GOOD + "nodes: {continuity: 3}\neasing: {degree: 6}\n", "9:18: easing.degree: 6; continuity 3 at the nodes needs degree 7 or more"),
    "objective": (GOOD + "objective: tme\n", '8:12: objective: "tme"; allowed: time, or a mapping like {minimise: jerk, total_time: 60 s}'),
    "baseline": (GOOD + "baselines: [quintic, double]\n", '8:22: baselines[2]: "double"; allowed: quintic, double-s; did you mean "double-s"?'),
    "baselines as text": (GOOD + "baselines: quintic\n", '8:12: baselines: "quintic"; a list is needed'),
    "rate": (GOOD + "output: {rate: 100}\n", '8:16: output.rate: "100" has no unit; write a frequency like "100 Hz"'),
    "rate out of range": (GOOD + "output: {rate: 0 Hz}\n", '8:16: output.rate: "0 Hz" is out of range; 1e-09 to 1e+09 1/s are allowed'),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_the_exact_message(case):
    text, message = CASES[case]
    with pytest.raises(InputError) as error:
        parse_problem(text, "scan.yaml")
    assert str(error.value) == f"scan.yaml:{message}"
    assert error.value.exit_code == 2


def test_all_faults_are_reported_at_once_in_the_order_of_the_file():
    text = "timelaw: 1\nname: a b\nroute: {orientations: {lattice: x}}\nlimits: {jerk: 3}\n"
    with pytest.raises(InputError) as error:
        parse_problem(text, "scan.yaml")
    assert [fault.line for fault in error.value.faults] == [2, 3, 4]


def test_the_good_file_is_good():
    assert parse_problem(GOOD).name == "scan"


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(InputError, match=r"none\.yaml: cannot be read: No such file or directory"):
        load_problem(tmp_path / "none.yaml")
    (tmp_path / "latin.yaml").write_bytes("name: Grüße".encode("latin-1"))
    with pytest.raises(InputError, match=r"latin\.yaml:1:9: is not a UTF-8 text"):
        load_problem(tmp_path / "latin.yaml")
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        load_problem(tmp_path)


def test_yaml_1_2_and_byte_order_marks(tmp_path):
    """In YAML 1.1 `no` would be false; files from other editors may start with a mark."""
    (tmp_path / "marked.yaml").write_bytes(b"\xef\xbb\xbf" + replaced("scan", "no").encode())
    assert load_problem(tmp_path / "marked.yaml")[0].name == "no"
