"""Studies: every combination designed, the front monotone, faults with their places."""

import csv
import json
import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest

from tests.cases import PROBLEMS
from timelaw.errors import InputError
from timelaw.study import plan_study, read_study, run_study
from timelaw.study.executors import open_executor
from timelaw.study.table import format_study

HEAD = "timelaw-study: 1\nname: test\nproblem: p.yaml\n"


@pytest.fixture
def study(tmp_path):
    (tmp_path / "p.yaml").write_text((PROBLEMS / "paper-24-cell.yaml").read_text())

    def make(text):
        (tmp_path / "s.yaml").write_text(HEAD + text)
        return read_study(tmp_path / "s.yaml")

    return make


def test_ranges_lists_and_their_combinations(study):
    made = study(
        "vary:\n  limits.jerk: {from: 300 deg/s^3, to: 600 deg/s^3, steps: 3}\n  easing.degree: [7, 9]\n"
    )
    assert made.vary == {
        "limits.jerk": ("300 deg/s^3", "450 deg/s^3", "600 deg/s^3"),
        "easing.degree": (7, 9),
    }
    assert made.size == 6
    assert list(made.points())[1] == {"limits.jerk": "300 deg/s^3", "easing.degree": 9}
    assert study("vary: {easing.degree: {from: 7, to: 13, steps: 4}}").vary["easing.degree"] == (7, 9, 11, 13)


def test_more_jerk_is_faster_and_the_table_says_so(study):
    made = study("vary: {limits.jerk: [200 deg/s^3, 600 deg/s^3, 2000 deg/s^3]}\n")
    outcomes = run_study(plan_study(made))
    durations = [outcome.duration for outcome in outcomes]
    assert durations == sorted(durations, reverse=True)
    assert all(outcome.holds for outcome in outcomes)
    rows = list(csv.DictReader(format_study(outcomes).splitlines()))
    assert [float(row["time [s]"]) for row in rows] == durations
    assert rows[1]["limits.jerk"] == "600 deg/s^3"
    assert float(rows[1]["time [s]"]) == pytest.approx(28.8289, abs=1e-3)


def test_processes_give_what_one_process_gives(study):
    made = study("vary: {easing.degree: [7, 9, 11]}\n")
    with open_executor(processes=2, cluster=None) as executor:
        assert run_study(plan_study(made), executor) == run_study(plan_study(made))


def test_the_front_of_time_against_jerk_falls(study):
    made = study(
        "vary:\n  objective.minimise: [jerk]\n"
        "  objective.total_time: {from: 1 x minimum, to: 3 x minimum, steps: 4}\n"
    )
    outcomes = run_study(plan_study(made))
    efforts = [outcome.efforts["jerk"] for outcome in outcomes]
    assert efforts == sorted(efforts, reverse=True)
    # in three times the time each leg between stops is nearly the quintic in its share of it: E falls as T^-5
    assert efforts[-1] < efforts[0] / 3**5


def test_what_cannot_be_met_is_an_outcome(study):
    made = study("vary:\n  objective.minimise: [jerk]\n  objective.total_time: [20 s, 40 s]\n")
    late, good = run_study(plan_study(made))
    assert late.duration is None
    assert "too early for the end" in late.status
    assert good.holds


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("vary: {}\n", "Dictionary should have at least 1 item"),
        ("vary: {easing.degree: 9}\n", "a list of values or a range {from: …, to: …, steps: …} is needed"),
        ("vary: {limits.jerk: {from: 3 deg/s^3, to: 4 rad/s^3, steps: 3}}\n", "both need a number and the same unit"),
        ("vary: {easing.degree: {from: 7, to: 9, steps: 1}}\n", "steps: 1; a whole number from 2 to 10000 is needed"),
        ("vary: {limits.jerk: [7 deg/s^3], limits: [{jerk: 1 deg/s^3}]}\n", '"limits.jerk" is a part of "limits"; vary one of them'),
        ("vary: {easing.degree: [7]}\nefort: jerk\n", 's.yaml:5:1: unknown key "efort"; allowed: timelaw-study, name, problem, vary, effort; did you mean "effort"?'),
        ("vary: {easing.degree: [7]}\neffort: noise\n", 's.yaml:5:9: effort: "noise"; allowed: jerk, energy, torque, snap'),
    ],
)  # fmt: skip
def test_malformed_studies(study, text, message):
    with pytest.raises(InputError) as error:
        study(text)
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ("{easing.degre: [7]}", 's.yaml:4:7: vary: with easing.degre = 7: easing: unknown key "degre"'),
        ("{limits.jerk: [7]}", 's.yaml:4:7: vary: with limits.jerk = 7: limits.jerk: "7" has no unit'),
    ],
)
def test_values_no_problem_file_may_have_are_refused(study, vary, message):
    with pytest.raises(InputError) as error:
        plan_study(study(f"vary: {vary}\n"))
    assert message in str(error.value)


def test_the_command_writes_table_and_picture(tmp_path):
    (tmp_path / "p.yaml").write_text((PROBLEMS / "first-steps.yaml").read_text())
    (tmp_path / "s.yaml").write_text(HEAD + "vary: {easing.degree: [7, 9]}\n")
    command = [
        sys.executable,
        "-m",
        "timelaw",
        "sweep",
        str(tmp_path / "s.yaml"),
        "-o",
        str(tmp_path / "o"),
        "--processes",
        "1",
        "--json",
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0
    result = json.loads(done.stdout)
    assert [row["point"] for row in result["designs"]] == [{"easing.degree": 7}, {"easing.degree": 9}]
    assert ET.parse(tmp_path / "o" / "front.svg").getroot().tag.endswith("svg")
    assert len((tmp_path / "o" / "sweep.csv").read_text().splitlines()) == 3
