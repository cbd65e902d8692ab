"""`timelaw tour`: what it says against SOURCES, and that its file is read back as the same tour."""

import json
import xml.etree.ElementTree as ET
from collections import Counter

import numpy as np
import pytest

from tests.cases import PROBLEMS
from timelaw.cli.tour import run
from timelaw.errors import InputError
from timelaw.orientations.table import read_table
from timelaw.pipeline import lay_out
from timelaw.report.tour_text import describe_merits
from timelaw.tours import Tour
from timelaw.tours.merit import Merit


def test_the_papers_tour(capsys):
    found, text = _paper(capsys)
    assert found["tour"] == ["1", "12", "11", "3", "8", "10", "2", "7", "9", "6", "5", "4"]
    assert [turn["node"] for turn in found["turns"] if turn["kind"] == "straight"] == ["11", "8", "7"]
    assert Counter(round(turn["turn"], 2) for turn in found["turns"]) == {0.0: 3, 70.53: 2, 109.47: 5}
    assert found["time_over_runs"] == pytest.approx(27.6, rel=1e-12)
    assert found["time_with_every_stop"] == pytest.approx(29.7, rel=1e-12)
    assert "no tour is shorter: 11 legs × the minimal distance 120° = 1320°" in text


def _paper(capsys):
    assert run(str(PROBLEMS / "paper-24-cell.yaml"), None, table=True, as_json=True) == 0
    captured = capsys.readouterr()
    # table 1: arcs on S³ without absolute value, 32 of 60°, 18 of 90°, 16 of 120° above the diagonal
    rows = [line.split() for line in captured.err.splitlines()]
    table = [row[1:] for row in rows if len(row) == 13 and row[0].isdigit()]
    upper = [table[i][j] for i in range(12) for j in range(i + 1, 12)]
    assert Counter(upper) == {"60": 32, "90": 18, "120": 16}
    return json.loads(captured.out), captured.err


def test_a_tour_that_is_not_shortest_says_by_how_much_at_most(capsys, tmp_path):
    text = (PROBLEMS / "paper-24-cell.yaml").read_text()
    path = tmp_path / "p.yaml"
    path.write_text(text.replace("tour: paper", "tour: [1, 2, 12, 11, 3, 8, 10, 7, 9, 6, 5, 4]"))
    assert run(str(path), None, table=False, as_json=True) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["is_shortest"] is False
    excess = found["length"] / (11 * 120) - 1
    assert f"at most {excess:.2%} too long" in found["certificate"]


@pytest.mark.parametrize("closed", ["false", "true"])
def test_the_file_is_read_back_as_the_same_tour(capsys, tmp_path, closed):
    text = (
        (PROBLEMS / "gimbal-600-cell.yaml")
        .read_text()
        .replace("tour: shortest", f"closed: {closed}\n  tour: shortest")
    )
    (tmp_path / "p.yaml").write_text(text)
    assert run(str(tmp_path / "p.yaml"), str(tmp_path / "tour.csv"), table=False, as_json=False) == 0
    capsys.readouterr()
    assert ET.parse(tmp_path / "tour.svg").getroot().tag.endswith("svg")
    again = text.replace("{lattice: 600-cell}", "{file: tour.csv}").replace("tour: shortest", "tour: given")
    (tmp_path / "q.yaml").write_text(again)
    one, other = lay_out(tmp_path / "p.yaml"), lay_out(tmp_path / "q.yaml")
    assert [n.label for n in one.route.nodes] == [n.label for n in other.route.nodes]
    np.testing.assert_array_equal(
        read_table(tmp_path / "tour.csv")[0], one.orientations.quaternions[list(one.tour.order)]
    )
    assert [n.kind for n in one.route.nodes] == [n.kind for n in other.route.nodes]


def test_an_orientation_visited_twice_has_no_bound_but_a_tour(capsys, tmp_path):
    (tmp_path / "p.yaml").write_text(
        "timelaw: 1\nname: p\nroute: {orientations: {as: rotation-vector, unit: deg, list: "
        "[[0,0,0],[0,0,40],[0,0,0],[0,50,0]]}}\nlimits: {velocity: 60 deg/s}\nnodes: {continuity: 1}\n"
    )
    layout = lay_out(tmp_path / "p.yaml")
    assert describe_merits(layout.tour) == [
        "length 130°; no bound is known for how much shorter a tour can be"
    ]
    assert run(str(tmp_path / "p.yaml"), None, table=False, as_json=True) == 0
    assert "some orientations are the same, q and -q being one: 3 is 1" in capsys.readouterr().err


def test_the_picture_does_not_take_the_place_of_the_orientations(tmp_path):
    with pytest.raises(InputError, match="it names the orientation file"):
        run(str(PROBLEMS / "paper-24-cell.yaml"), str(tmp_path / "x.svg"), table=False, as_json=False)


@pytest.mark.parametrize("value", [1 / 3, 0.0077686166, 12.34567891, 123456.789])
def test_bounds_are_never_printed_above_what_is_proved(value):
    merit = Merit("turning", 2 * value, value, "counting")
    (text,) = describe_merits(Tour((0, 1, 2), False, 1.0, 0.1, (merit,)))
    shown = float(text.split("than ")[1].split("°")[0])
    assert np.degrees(value) * (1 - 1e-5) < shown <= np.degrees(value)
