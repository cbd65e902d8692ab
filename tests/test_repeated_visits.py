"""A listed tour may come back: rules by label hold at every visit and on every leg, from file to certificate."""

import json

import numpy as np
import pytest

from timelaw import design
from timelaw.certificate import certify
from timelaw.cli.app import _run
from timelaw.errors import InputError
from timelaw.export import format_law
from timelaw.law_file.document import from_document
from timelaw.pipeline import lay_out

HOME = """\
timelaw: 1
name: home
route:
  orientations: {list: [[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0.6, 0, 0.8, 0], [0.6, 0, 0, 0.8]]}
  tour: [1, 2, 1, 3, 1, 4]
limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}
"""


def write(tmp_path, *lines, **replaced):
    text = HOME
    for old, new in replaced.items():
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "home.yaml"
    path.write_text(text + "\n".join(lines) + "\n")
    return path


def proved(designed):
    document = json.loads(format_law(designed.optimised.law, designed.optimised.certificate, {}))
    assert certify(from_document(document)).findings() == []
    return designed.optimised.law


def test_home_after_each_pose(tmp_path):
    rules = "nodes: {at: {1: {dwell: 1 s}, 3: {dwell: 2 s, limits: {velocity: 20 deg/s}}}}"
    law = proved(design(write(tmp_path, rules, "segments: {3-1: {limits: {velocity: 10 deg/s}}}")))
    dwells = [(s.at, s.duration) for s in law.segments if s.kind == "dwell"]
    assert dwells == [("1", 1.0), ("1", 1.0), ("3", 2.0), ("1", 1.0)]
    fastest = {}
    for s in law.segments:
        if s.kind == "arc":
            t = np.linspace(s.start_time, s.end_time, 400)[1:-1]
            fastest[s.name] = np.degrees(np.max(np.linalg.norm(law(t, 1), axis=1)))
    assert fastest["1–3"] == pytest.approx(20, rel=1e-3)
    assert fastest["3–1"] == pytest.approx(10, rel=1e-3)
    assert fastest["1–4"] > 50


def test_a_rule_for_a_leg_holds_whenever_it_is_gone(tmp_path):
    tour = {"[1, 2, 1, 3, 1, 4]": "[1, 2, 3, 1, 2, 4]"}
    law = proved(design(write(tmp_path, "segments: {1-2: {duration: 7 s}}", **tour)))
    assert [s.duration for s in law.segments if s.name == "1–2"] == pytest.approx([7.0, 7.0], rel=1e-12)
    law = proved(design(write(tmp_path, "segments: {1-2: {limits: {velocity: 10 deg/s}}}", **tour)))
    assert all(s.duration > 10 for s in law.segments if s.name == "1–2")


def test_a_closed_tour_may_come_back_too(tmp_path):
    rules = "nodes: {at: {1: {dwell: 1 s, limits: {velocity: 20 deg/s}}}}"
    path = write(tmp_path, rules, **{"[1, 2, 1, 3, 1, 4]": "[1, 2, 1, 3, 4]\n  closed: true"})
    law = proved(design(path))
    assert [s.at for s in law.segments if s.kind == "dwell"] == ["1", "1"]
    slow = {s.name for s in law.segments if s.kind == "arc" and s.duration > 5}
    assert slow == {"1–2", "2–1", "1–3", "4–1"}


def test_a_listed_return_is_a_visit_of_its_own(tmp_path):
    path = write(tmp_path, "nodes: {dwell: 1 s}", **{"[1, 2, 1, 3, 1, 4]": "[1, 2, 3, 4, 1]"})
    assert lay_out(path).requirements.dwells == (1.0,) * 5


def test_a_time_needs_one_visit(tmp_path):
    with pytest.raises(InputError) as error:
        lay_out(write(tmp_path, "nodes: {at: {1: {time: 40 s}}}"))
    message = 'nodes.at.1.time: the tour visits "1" 3 times; it is not said which visit is meant'
    assert str(error.value).endswith(message)
    assert lay_out(write(tmp_path, "nodes: {at: {3: {time: 40 s}}}")).requirements.arrivals == {3: 40.0}


def test_a_stop_holds_at_the_visits_in_between(tmp_path):
    assert lay_out(write(tmp_path, "nodes: {at: {1: {stop: true}}}")).requirements.stops >= {2, 4}


def test_a_leg_that_may_be_two_is_not_guessed(tmp_path):
    (tmp_path / "p.csv").write_text("label,w,x,y,z\na,1,0,0,0\nb-c,0,1,0,0\na-b,0,0,1,0\nc,0,0,0,1\n")
    text = HOME.replace("[1, 2, 1, 3, 1, 4]", "[a, b-c, a-b, c]").splitlines()
    text[3] = "  orientations: {file: p.csv}"
    (tmp_path / "p.yaml").write_text("\n".join([*text, "segments: {a-b-c: {duration: 9 s}}"]))
    with pytest.raises(InputError, match='"a-b-c" may be from "a" to "b-c" or from "a-b" to "c"'):
        lay_out(tmp_path / "p.yaml")


def test_the_tour_as_a_table_can_be_read_again(tmp_path, capsys):
    assert _run(["tour", str(write(tmp_path)), "-o", str(tmp_path / "tour.csv"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["tour"] == ["1", "2", "1", "3", "1", "4"]
    text = HOME.splitlines()
    text[3:5] = ["  orientations: {file: tour.csv}"]
    (tmp_path / "again.yaml").write_text("\n".join(text))
    again = lay_out(tmp_path / "again.yaml")
    assert again.orientations.labels == ("1", "2", "1 (2)", "3", "1 (3)", "4")
    np.testing.assert_allclose(again.route.angles, lay_out(write(tmp_path)).route.angles)


ALIKE = "[[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0.6, 0.8, 0, 0], [0.6, 0, 0, 0.8]]"


def test_equal_orientations_in_a_row_say_what_to_do(tmp_path):
    whole = {"[[1, 0, 0, 0], [0.6, 0.8, 0, 0], [0.6, 0, 0.8, 0], [0.6, 0, 0, 0.8]]": ALIKE}
    tour = {"  tour: [1, 2, 1, 3, 1, 4]\n": ""}
    with pytest.raises(InputError) as error:
        lay_out(write(tmp_path, **whole, **tour))
    message = 'route.tour: "2" and "3" follow each other and are the same orientation; leave one out, or add duplicates: merge to the orientations'
    assert str(error.value).endswith(message)
    merged = {next(iter(whole)): f"{ALIKE}, duplicates: merge"}
    assert len(lay_out(write(tmp_path, **merged, **tour)).route.legs) == 2
    with pytest.raises(InputError, match='"3" is the same orientation as "2" and merged with it; say "2"'):
        lay_out(write(tmp_path, **merged))


LABELS = "label,w,x,y,z\n001,1,0,0,0\n002,0,1,0,0\n010,0,0,1,0\n"


@pytest.mark.parametrize(
    ("lines", "message"),
    [
        (["  tour: [001, 002, 010]"], "5:10: route.tour[1]: 001 without quotes is the number 1; write \"001\" if that is the label"),
        (["  tour: shortest", "  start: 010"], '6:10: route.start: 010 without quotes is the number 10; write "010" if that is the label'),
        (["  tour: shortest", "  end: 0o17"], '6:8: route.end: 0o17 without quotes is the number 15; write "0o17" if that is the label'),
        (["nodes: {at: {002: {dwell: 1 s}}}"], '5:14: nodes.at.002: 002 without quotes is the number 2; write "002" if that is the label'),
        (["  tour: [1, 2, 10]"], '5:9: route.tour: no orientation is called "1"; there are 001, 002, 010'),
        (["  tour: shortest", "  start: 1"], '6:10: route.start: no orientation is called "1"; there are 001, 002, 010'),
        (["nodes: {at: {2: {dwell: 1 s}}}"], '5:17: nodes.at.2: the tour has no node "2"; it has 001, 002, 010'),
        (["segments: {1-2: {duration: 1 s}}"], '5:17: segments.1-2: the tour has no leg "1-2"; it has 001-002, 002-010'),
    ],
)  # fmt: skip
def test_labels_that_look_like_numbers(tmp_path, lines, message):
    (tmp_path / "p.csv").write_text(LABELS)
    text = [*HOME.splitlines()[:3], "  orientations: {file: p.csv}", *lines, HOME.splitlines()[5]]
    path = tmp_path / "p.yaml"
    path.write_text("\n".join(text))
    with pytest.raises(InputError) as error:
        lay_out(path)
    assert str(error.value.faults[0]) == f"{path}:{message}"


def test_quoted_labels_are_what_they_are(tmp_path):
    (tmp_path / "p.csv").write_text(LABELS)
    rules = 'nodes: {at: {"002": {dwell: 1 s}}}\nsegments: {001-002: {duration: 9 s}}'
    text = [*HOME.splitlines()[:3], "  orientations: {file: p.csv}", '  tour: ["001", "002", "010", "001"]', HOME.splitlines()[5], rules]  # fmt: skip
    (tmp_path / "p.yaml").write_text("\n".join(text))
    assert lay_out(tmp_path / "p.yaml").requirements.dwells == (0.0, 1.0, 0.0, 0.0)
