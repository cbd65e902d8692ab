"""`timelaw compare`: numbers by quadrature of the laws themselves, refusals that say what differs."""

import json
import re
from dataclasses import replace
from math import inf

import numpy as np
import pytest

from tests.cases import PROBLEMS
from timelaw.cli.app import run_command
from timelaw.law_file import read_law
from timelaw.limits.body import RigidBody
from timelaw.report.comparison.compared import Compared, name_apart, read_compared
from timelaw.report.comparison.criteria import CRITERIA, Criterion, Line, list_lines, order_names, rank
from timelaw.report.comparison.routes import find_route_difference, list_setting_differences

RESULTS = PROBLEMS.parent / "results"
ARCS, THROUGH = RESULTS / "paper-24-cell", RESULTS / "paper-24-cell-through"


@pytest.fixture(scope="module")
def compared():
    return [read_compared(str(ARCS)), read_compared(str(THROUGH / "law.json"))]


def run(capsys, *arguments):
    code = run_command(["compare", *map(str, arguments), "--json"])
    captured = capsys.readouterr()
    return code, json.loads(captured.out), captured.err


def test_numbers_are_those_of_the_laws(compared):
    """Squares of rates by the midpoint rule over the law, peaks by sampling, the time by the file."""
    lines = {line.criterion.key: line.values for line in list_lines([c.entry for c in compared])}
    assert set(lines) == {c.key for c in CRITERIA} - {"torque"}
    for k, folder in enumerate((ARCS, THROUGH)):
        law, document = read_law(folder / "law.json")
        assert lines["time"][k] == lines["motion"][k] == document["duration"]
        step = law.duration / 200_000
        t = (np.arange(200_000) + 0.5) * step
        for order, key, effort in (
            (1, "velocity", None),
            (2, "acceleration", "energy"),
            (3, "jerk", "smoothness"),
        ):
            size = np.linalg.norm(law(t, order), axis=1)
            assert lines[key][k] == pytest.approx(np.degrees(size.max()), rel=1e-3)
            if effort:
                assert lines[effort][k] == pytest.approx(float(np.sum(size**2) * step), rel=1e-3)


def test_torque_is_a_criterion_where_all_bodies_are_known(compared):
    law = compared[0].entry.law
    body = RigidBody(np.diag([12.0, 10.0, 8.0]))
    entry = replace(compared[0].entry, law=replace(law, body=body))
    (line,) = [line for line in list_lines([entry, entry]) if line.criterion.key == "torque"]
    t = (np.arange(100_000) + 0.5) * law.duration / 100_000
    omega, alpha = law(t, 1), law(t, 2)
    torque = alpha @ body.inertia.T + np.cross(omega, omega @ body.inertia.T)
    assert line.values[0] == pytest.approx(np.sum(torque**2) * law.duration / 100_000, rel=1e-3)
    assert "torque" not in {line.criterion.key for line in list_lines([entry, compared[1].entry])}


def test_ranks_and_their_words():
    assert rank([3.0, 1.0, 2.0]) == (3, 1, 2)
    assert rank([2.0, 2.0 * (1 + 1e-12), 1.0]) == (2, 2, 1)
    assert rank([inf, inf, 1.0]) == (2, 2, 1)
    assert rank([2, 3, 3], more_is_better=True) == (3, 1, 1)
    line = Line(Criterion("x", "x", "s", lambda _: 0.0), (2.0, 2.0, 1.0), (2, 2, 1))
    assert order_names(line, ["a", "b", "c"]) == "1. c, 2. a = b"
    assert line.difference(2) == pytest.approx(-0.5)
    assert Line(line.criterion, (inf, 1.0), (2, 1)).difference(1) is None


def test_a_table_a_ranking_and_a_page(capsys, tmp_path):
    code, found, text = run(capsys, ARCS, THROUGH, "-o", tmp_path / "out")
    assert code == 0
    assert found["ok"]
    assert [law["name"] for law in found["laws"]] == ["paper-24-cell", "paper-24-cell-through"]
    assert found["ranking"]["time"] == {"paper-24-cell": 2, "paper-24-cell-through": 1}
    assert found["differences"] == []
    assert re.search(r"23\.70\d+ \(-17\.\d+ %\)", text)
    assert "total time: 1. paper-24-cell-through, 2. paper-24-cell" in text
    page = (tmp_path / "out" / "compare.html").read_text()
    assert "2 laws over one route" in page
    assert page.count("<svg") == 4
    for name in ("compare-laws.svg", "compare-rates.svg"):
        assert (tmp_path / "out" / name).read_text().count("paper-24-cell-through") >= 1


def test_a_problem_is_designed_first(capsys):
    code, found, _ = run(capsys, PROBLEMS / "paper-24-cell.yaml", ARCS)
    assert code == 0
    assert [law["name"] for law in found["laws"]] == ["paper-24-cell.yaml", "paper-24-cell"]
    times = [law["time"] for law in found["laws"]]
    assert times[0] == pytest.approx(times[1], rel=1e-6)
    assert set(found["ranking"]["time"].values()) <= {1, 2}


def test_another_route_is_refused_with_what_differs_unless_it_is_wanted(capsys, tmp_path):
    document = json.loads((ARCS / "law.json").read_text())
    document["segments"] = document["segments"][:3]
    short = tmp_path / "short.json"
    short.write_text(json.dumps(document))
    code, found, text = run(capsys, ARCS, short)
    assert code == 2
    assert f"timelaw: {short}: another route than {ARCS}: it has 4 nodes, not 12" in text
    assert "--any-route" in found["errors"][0]["message"]
    code, found, _ = run(capsys, ARCS, short, "--any-route")
    assert (
        found["differences"][0] == "short.json has another route than paper-24-cell: it has 4 nodes, not 12"
    )


def test_routes_differ_by_orientation_too(compared):
    law = compared[0].entry.law
    last = law.segments[-1]
    turned = replace(law, segments=(*law.segments[:-1], replace(last, end=np.array([1.0, 0.0, 0.0, 0.0]))))
    angle = np.degrees(2 * np.arccos(abs(last.end[0])))
    assert find_route_difference(law, turned).startswith(
        f'node 12 of 12, "{last.target}", is {angle:.4g}° away from'
    )
    mirrored = replace(law, segments=(*law.segments[:-1], replace(last, end=-last.end)))
    assert find_route_difference(law, mirrored) == ""
    assert find_route_difference(law, compared[1].entry.law) == ""


def test_other_limits_rests_and_classes_are_told(compared):
    law = compared[0].entry.law
    other = replace(law, limits={**law.limits, "jerk": 1.0}, continuity=1)
    assert list_setting_differences([("a", law), ("b", law)]) == []
    assert list_setting_differences([("a", law), ("b", other)]) == [
        "b has other limits than a",
        "b was asked to be C1, a C2",
    ]


def test_laws_of_one_name_are_told_apart_by_their_paths(compared):
    entry = compared[0].entry
    laws = [Compared(entry, source) for source in ("a/x/law.json", "b/x/law.json", "b/y")]
    assert [c.entry.name for c in name_apart(laws)] == ["a/x/law.json", "b/x/law.json", "y"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([ARCS], "1 to compare; 2 to 12 are needed"),
        ([ARCS, PROBLEMS], f'{PROBLEMS}: a folder without results: it has no "law.json"'),
        ([ARCS, "nothing.json"], "nothing.json: "),
    ],
)
def test_what_cannot_be_compared_is_exit_2(capsys, arguments, message):
    code, found, text = run(capsys, *arguments)
    assert code == 2
    assert found["ok"] is False
    assert message in text


def test_a_law_that_breaks_its_limits_is_a_finding(capsys, tmp_path):
    document = json.loads((ARCS / "law.json").read_text())
    document["limits"]["velocity"] = 0.9
    path = tmp_path / "law.json"
    path.write_text(json.dumps(document))
    code, found, text = run(capsys, ARCS, path)
    assert code == 1
    assert "velocity reaches" in found["findings"][0]
    assert "has other limits than" in text
