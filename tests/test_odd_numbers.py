"""Numbers that nobody can reckon with, wherever a file takes one: a message with its place, never a traceback."""

import json
import random
import re
from math import inf, nan

import numpy as np
import pytest

from tests.cases import PROBLEMS
from timelaw.certificate import certify
from timelaw.cli.app import _run
from timelaw.cli.console import print_json
from timelaw.errors import InputError
from timelaw.export import format_law, format_samples
from timelaw.export.samples import count_rows
from timelaw.law_file.document import from_document, to_document
from timelaw.pipeline import lay_out_problem
from timelaw.problem.load import check_problem
from timelaw.problem.source import read
from timelaw.results_folder.manifest import MANIFEST
from timelaw.study import read_study

WHOLE = """\
timelaw: 1
name: scan
route:
  orientations: {list: [[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0, 0, 1, 0]], turned: {world: [1, 0, 0, 0]}, duplicates: merge, tolerance: 0.1 deg}
  tour: [1, 2, 1, 3]
body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2], actuator: wheels, momentum: [0 N*m*s, 0 N*m*s, 0.1 N*m*s]}
limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: [600 deg/s^3, 600 deg/s^3, 300 deg/s^3], snap: 6000 deg/s^4, torque: 2 N*m, momentum: 40 N*m*s}
nodes: {continuity: 3, dwell: 0.5 s, at: {2: {dwell: 2 s}, 3: {time: 40 s, limits: {velocity: 20 deg/s}}}, start: {velocity: 1 deg/s, acceleration: 0 deg/s^2}}
segments: {1-2: {duration: 4 s}, 2-1: {limits: {velocity: 10 deg/s}}}
easing: {basis: spline, degree: 5, intervals: 50}
objective: {minimise: jerk, total_time: 1.5 x minimum}
output: {rate: 100 Hz}
"""
HUGE = "1" + "0" * 400
ODD = [HUGE, f"-{HUGE}", "9" * 5000, "0x" + "f" * 6000, "1e400", "1e-400", "-0", ".nan", ".inf", "-.inf", "inf", "nan", "null", "true", "''", "[]", "{}", "1_000", "0o17", "1e308", "-1", "0", f"'{HUGE}'", "[[[]]]"]  # fmt: skip
TYPED = re.compile(r"(?<![\w.^-])-?\d+(?:\.\d+)?(?![\w^])")


def test_the_whole_file_is_good():
    source = read(WHOLE, "p.yaml")
    assert lay_out_problem(PROBLEMS, check_problem(source), source).route.legs


@pytest.mark.parametrize("place", range(len(TYPED.findall(WHOLE))))
def test_every_number_of_a_problem_file(place):
    match = list(TYPED.finditer(WHOLE))[place]
    faults = []
    for odd in ODD:
        try:
            source = read(WHOLE[: match.start()] + odd + WHOLE[match.end() :], "p.yaml")
            lay_out_problem(PROBLEMS, check_problem(source), source)
        except InputError as error:
            faults.append(error.faults)
    assert len(faults) > len(ODD) / 2
    assert all(fault.path == "p.yaml" and fault.line for found in faults for fault in found)


@pytest.mark.parametrize("odd", ODD)
def test_numbers_of_a_study_file(odd, tmp_path):
    (tmp_path / "p.yaml").write_text(WHOLE)
    text = (
        "timelaw-study: 1\nname: a\nproblem: p.yaml\nvary:\n  limits.snap: {{from: {}, to: {}, steps: {}}}\n"
    )
    for numbers in ((odd, "3", "4"), ("3", odd, "4"), ("3", "9", odd)):
        (tmp_path / "s.yaml").write_text(text.format(*numbers))
        try:
            study = read_study(tmp_path / "s.yaml")
        except InputError:
            continue
        assert all(np.isfinite(float(point["limits.snap"])) for point in study.points())


def test_a_huge_whole_number_has_its_place():
    with pytest.raises(InputError) as error:
        read(WHOLE.replace("[0, 0, 1, 0]", f"[0, 0, {HUGE}, 0]"), "p.yaml")
    message = "a whole number of more than 300 digits; none here is that large"
    assert str(error.value) == f"p.yaml:4:64: route.orientations.list[3][3]: {message}"


@pytest.mark.parametrize("free", ["inf", ".inf", "null", "none", "'-'", "inf deg/s", "~", ".nan"])
def test_an_axis_without_a_limit(free):
    with pytest.raises(InputError, match='; give an axis without a limit a large one, such as "1e6 deg/s"'):
        check_problem(
            read(WHOLE.replace("velocity: 60 deg/s", f"velocity: [60 deg/s, {free}, 60 deg/s]"), "p")
        )
    with pytest.raises(InputError, match="; leave the key away where there is no limit"):
        check_problem(read(WHOLE.replace("velocity: 60 deg/s", f"velocity: {free}"), "p"))


def test_what_is_said_of_a_free_axis_works(tmp_path):
    route = "{orientations: {list: [[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0.6, 0, 0.8, 0]]}}"
    limits = "{velocity: [60 deg/s, 1e6 deg/s, 1e6 deg/s], acceleration: 120 deg/s^2, jerk: 600 deg/s^3}"
    (tmp_path / "p.yaml").write_text(f"timelaw: 1\nname: p\nroute: {route}\nlimits: {limits}\n")
    assert _run(["design", str(tmp_path / "p.yaml"), "-o", str(tmp_path / "out")]) == 0


def altered(paper, change):
    document = json.loads(json.dumps(to_document(paper.optimised.law)))
    change(document["segments"])
    return document


def test_labels_that_differ_at_a_joint_are_a_finding_in_json(paper, tmp_path, capsys):
    document = altered(paper, lambda segments: segments[3].update({"from": "elsewhere"}))
    (tmp_path / "law.json").write_text(json.dumps(document))
    assert _run(["verify", str(tmp_path / "law.json"), "--json"]) == 1
    result = json.loads(capsys.readouterr().out)
    joint = next(check for check in result["certificate"]["checks"] if check["check"] == "nodes are met")
    assert joint["worst"] is None
    assert joint["holds"] is False
    assert any("nodes are met: off by inf rad" in finding for finding in result["findings"])


def test_a_law_file_says_null_of_what_is_not_finite(paper):
    law = from_document(altered(paper, lambda segments: segments[3].update({"from": "elsewhere"})))
    document = json.loads(format_law(law, certify(law), {"gap": nan}), parse_constant=pytest.fail)
    assert document["provenance"]["gap"] is None
    assert any(check["worst"] is None for check in document["certificate"]["checks"])


def test_json_is_json(capsys):
    print_json({"a": [inf, (-inf, 1.5)], "b": {"c": nan, "d": np.float64(inf)}, "e": True})
    assert json.loads(capsys.readouterr().out, parse_constant=pytest.fail) == {
        "a": [None, [None, 1.5]],
        "b": {"c": None, "d": None},
        "e": True,
    }


def test_numbers_of_a_law_file(paper, tmp_path, capsys):
    rng, codes = random.Random(2), set()
    text = json.dumps(to_document(paper.optimised.law))
    places = list(re.finditer(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", text))
    for _ in range(60):
        match = rng.choice(places)
        odd = rng.choice(
            [HUGE, "1e400", "NaN", "-Infinity", "null", "1e308", "1e9", "-1e9", "1e-300", "0", "[]"]
        )
        (tmp_path / "law.json").write_text(text[: match.start()] + odd + text[match.end() :])
        codes.add(_run(["verify", str(tmp_path / "law.json"), "--json"]))
        json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert codes <= {0, 1, 2}
    assert {1, 2} <= codes


@pytest.mark.parametrize(
    ("steps", "rows"), [(3, 4), (3 + 1e-9, 4), (3 - 1e-9, 4), (3.5, 5), (0.2, 2), (1e-9, 2)]
)
def test_the_last_row_is_the_end_and_no_row_stands_beside_it(paper, steps, rows):
    law = paper.optimised.law
    rate = steps / law.duration
    lines = [
        line.split(",") for line in "".join(format_samples(law, rate)).splitlines() if line[0] in "0123456789"
    ]
    times = [float(line[0]) for line in lines]
    assert len(times) == rows == count_rows(law.duration, rate)
    assert times[-1] == pytest.approx(law.duration, rel=1e-14)
    assert np.min(np.diff(times)) > 0.1 * min(steps, 1) / rate


PLAIN = """\
timelaw: 1
name: many
route: {orientations: {list: [[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0, 0, 1, 0]]}}
limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}
"""


@pytest.mark.parametrize(
    ("lines", "count"),
    [
        ("output: {rate: 1 MHz}", None),
        ("output: {rate: 10000 kHz}", "at least 61710036 rows in 6.171 s"),
        ("output: {rate: 1000 kHz}\nobjective: {minimise: jerk, total_time: 60 s}", "at least 60000001 rows in 60 s"),
        ("output: {rate: 1000 kHz}\nobjective: {minimise: jerk, total_time: 10 x minimum}", "at least 61710036 rows in 61.71 s"),
    ],
)  # fmt: skip
def test_too_many_samples_are_refused_before_anything_is_solved(tmp_path, lines, count, monkeypatch, capsys):
    monkeypatch.setattr("timelaw.pipeline.optimise", pytest.fail)
    (tmp_path / "p.yaml").write_text(PLAIN + lines)
    assert _run(["design", str(tmp_path / "p.yaml"), "-o", str(tmp_path / "out")]) == 2
    told = capsys.readouterr().err
    assert "p.yaml:5:16: output.rate: " in told
    assert count is None or f"{count}; at most 20000000 are written, choose a lower rate, below" in told
    assert not (tmp_path / "out").exists()


def test_where_only_the_law_shows_it_nothing_else_is_lost(tmp_path, capsys):
    """How long a motion past the nodes takes is not known before."""
    (tmp_path / "p.yaml").write_text(PLAIN + "output: {rate: 10000 kHz}\nmotion: through")
    out = tmp_path / "out"
    out.mkdir()
    (out / "samples.csv").write_text("of another law")
    assert _run(["design", str(tmp_path / "p.yaml"), "-o", str(out), "--json"]) == 1
    done = capsys.readouterr()
    result = json.loads(done.out)
    finding = "samples.csv is left out: .*p.yaml:5:16: output.rate: 57.* rows in 5.728.* s; at most 40000000"
    assert re.search(finding, result["findings"][0])
    assert re.search(f"finding: {finding}", done.err)
    assert result["certificate"]["holds"] is True
    assert {path.name for path in out.iterdir()} == {
        "law.json",
        "report.html",
        "laws.svg",
        "rates.svg",
        "limits.svg",
        "passing.svg",
        MANIFEST,
    }
    assert [name for name in result["files"] if "samples" in name] == []
    assert _run(["verify", str(out / "law.json")]) == 0
