"""The motion in the page as data: numbers bit for bit, equal ones once, and a name for every kind and limit."""

import base64
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.browser.pages import make_law
from timelaw import design
from timelaw.certificate import certify
from timelaw.law_file import read_law
from timelaw.limits import LIMITS
from timelaw.motion.deviation import DEVIATION
from timelaw.motion.kinds import KINDS
from timelaw.report.viewer.numbers import RECORDS
from timelaw.report.viewer.viewer import list_data, make_viewer

ROOT = Path(__file__).parent.parent
ASSETS = ROOT / "timelaw/report/viewer/assets"


@pytest.fixture(scope="module")
def law():
    return read_law(ROOT / "results/paper-24-cell/law.json")[0]


def read_numbers(data):
    return np.frombuffer(base64.b64decode(data["numbers"]), dtype="<f8")


def list_names(file, name):
    """The keys of an object of the script."""
    text = (ASSETS / file).read_text()
    start = text.index(f"const {name} = {{")
    return set(re.findall(r"^  (\w+): ", text[start : text.index("\n};", start)], re.MULTILINE))


def test_script_and_table_know_every_kind_and_every_limit():
    assert set(RECORDS) == set(KINDS) == list_names("segments.js", "KINDS")
    assert {*LIMITS, DEVIATION} == list_names("law.js", "LIMITED")


def test_the_table_holds_the_laws_numbers_bit_for_bit(law):
    data = list_data(law, certify(law))
    numbers = read_numbers(data)
    for segment, (kind, offset) in zip(law.segments, data["segments"], strict=True):
        assert data["kinds"][kind] == segment.kind
        record = [segment.start_time, segment.duration, *segment.start, *segment.end, *segment.axis]
        assert numbers[offset : offset + 13].tolist() == record
        at = int(numbers[offset + 13])
        assert numbers[at] == len(segment.profile.pieces)


def test_legs_that_are_run_through_alike_stand_once(law):
    """The paper's eleven legs are five runs of one leg and three of two: three easings."""
    data = list_data(law, certify(law))
    numbers = read_numbers(data)
    assert len({numbers[offset + 13] for _, offset in data["segments"]}) == 3


def test_three_hundred_different_legs_are_a_small_part_of_a_page():
    law = make_law(300)
    viewer = make_viewer(law, certify(law))
    assert len(viewer["data"]) + len(viewer["script"]) + len(viewer["style"]) < 300_000


def test_a_limit_of_one_leg_is_known_there(law):
    slow = replace(law.segments[2], limits={"velocity": 0.5})
    law = replace(law, segments=(*law.segments[:2], slow, *law.segments[3:]))
    limits = list_data(law, certify(law))["limits"]
    assert [limit["own"] for limit in limits] == [{2: 0.5}, {}, {}]
    assert limits[0]["peak"] > 1  # it is broken there, though not elsewhere


def test_the_shape_of_the_body_is_in_the_law_and_in_the_page(tmp_path):
    path = tmp_path / "box.yaml"
    path.write_text(
        "timelaw: 1\nname: box\nroute: {orientations: {list: [[1, 0, 0, 0], [0, 1, 0, 0]]}, tour: given}\nlimits: {jerk: 1 rad/s^3}\n"
        "body: {shape: [1 m, 1.5 m, 2 m]}\neasing: {basis: double-s}\nbaselines: []\n"
    )
    made = design(path).optimised
    assert list_data(made.law, made.certificate)["shape"] == (1.0, 1.5, 2.0)


def test_what_a_law_names_cannot_end_the_script(law):
    odd = replace(law.segments[0], origin="</script><b>")
    data = make_viewer(replace(law, segments=(odd, *law.segments[1:])), certify(law))["data"]
    assert "<" not in data
    assert json.loads(data)["labels"][0] == "</script><b>"
