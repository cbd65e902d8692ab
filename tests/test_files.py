"""Law files and samples: bit for bit, whole or not at all, and refused where malformed."""

import copy
import json
from dataclasses import replace

import numpy as np
import pytest

from tests.cases import reference
from timelaw.errors import InputError
from timelaw.export import format_law, format_samples
from timelaw.files import write_text
from timelaw.law_file import read_law
from timelaw.law_file.document import from_document, to_document
from timelaw.orientations.table import read_table


@pytest.fixture(scope="module")
def text(paper):
    return format_law(paper.optimised.law, paper.optimised.certificate, {"problem": "paper-24-cell.yaml"})


@pytest.mark.parametrize("name", ["optimised", "quintic", "double-S"])
def test_every_law_reads_back_bit_for_bit(paper, name):
    law = next(entry.law for entry in paper.laws if entry.name == name)
    back = from_document(json.loads(json.dumps(to_document(law))))
    t = np.linspace(0, law.duration, 1001)
    for order in range(4):
        np.testing.assert_array_equal(back(t, order), law(t, order))
    assert to_document(back) == to_document(law)


def test_the_file_has_the_contracts_keys(text):
    document = json.loads(text)
    assert list(document) == [
        "format",
        "version",
        "name",
        "timelaw",
        "conventions",
        "duration",
        "limits",
        "continuity",
        "segments",
        "nodes",
        "certificate",
        "provenance",
    ]
    assert document["conventions"] == {
        "quaternion": "wxyz, Hamilton, active, body to world",
        "rates": "body axes",
        "units": "rad, s",
    }
    segment = document["segments"][0]
    assert list(segment) == [
        "kind",
        "from",
        "to",
        "start_time",
        "duration",
        "start",
        "end",
        "axis",
        "angle",
        "pieces",
    ]
    assert list(segment["pieces"][0]) == ["duration", "state", "bernstein"]
    assert len(segment["pieces"][0]["state"]) == document["continuity"] + 1
    assert set(document["nodes"][1]) >= {"label", "time", "kind", "turn", "jump", "continuity"}
    assert document["limits"]["velocity"] == pytest.approx(np.pi / 3, rel=1e-15)


def test_the_same_design_writes_the_same_file(paper, text):
    assert (
        format_law(paper.optimised.law, paper.optimised.certificate, {"problem": "paper-24-cell.yaml"})
        == text
    )


def change(text, path, value):
    document = copy.deepcopy(json.loads(text))
    place = document
    for key in path[:-1]:
        place = place[key]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return json.dumps(document)


MALFORMED = {
    "format": (["format"], "other", "format: Input should be 'timelaw-law'"),
    "version": (["version"], 1, "version: Input should be 2"),
    "true version": (["version"], True, "version: Value error, Input should be 2"),
    "no limits": (["limits"], {}, "limits: at least one limit is needed, or there is nothing to prove"),
    "twice around": (
        ["segments", 0, "angle"],
        9.0,
        "segments[0].angle: Input should be less than or equal to",
    ),
    "no segments": (["segments"], [], "segments: List should have at least 1 item after validation, not 0"),
    "kind": (
        ["segments", 2, "kind"],
        "curve",
        "segments[2]: Input tag 'curve' found using 'kind' does not match",
    ),
    "short axis": (
        ["segments", 0, "axis"],
        [1.0, 0.0],
        "segments[0].axis: List should have at least 3 items",
    ),
    "text": (["segments", 0, "angle"], "2", "segments[0].angle: Input should be a valid number"),
    "zero time": (
        ["segments", 0, "duration"],
        0.0,
        "segments[0].duration: Input should be greater than or equal to 0.000000001",
    ),
    "no pieces": (["segments", 0, "pieces"], [], "segments[0].pieces: List should have at least 1 item"),
    "stateless": (
        ["segments", 0, "pieces", 0, "state"],
        [],
        "pieces[0].state: List should have at least 1 item",
    ),
    "missing": (["segments", 0, "pieces"], None, "segments[0].pieces: Field required"),
    "conventions": (["conventions", "quaternion"], "xyzw", "allowed: {'quaternion': 'wxyz, Hamilton, active"),
    "eternal": (
        ["segments", 0, "duration"],
        1e150,
        "segments[0].duration: Input should be less than or equal to",
    ),
    "brief": (
        ["segments", 0, "pieces", 0, "duration"],
        1e-200,
        "segments[0].pieces[0].duration: Input should be greater than or equal to",
    ),
    "wild": (
        ["segments", 0, "pieces", 0, "bernstein", 3],
        1e308,
        "pieces[0].bernstein[3]: Input should be less than",
    ),
    "limit": (["limits", "warp"], 9.0, 'limits: unknown limit "warp"; known: velocity, acceleration, jerk'),
    "negative limit": (
        ["limits", "jerk"],
        -9.0,
        "limits.jerk: Value error, a positive number, or three for the body axes, is needed",
    ),
}


@pytest.mark.parametrize("case", MALFORMED)
def test_malformed_law_files(tmp_path, text, case):
    path, value, message = MALFORMED[case]
    file = tmp_path / "law.json"
    file.write_text(change(text, path, value))
    with pytest.raises(InputError) as error:
        read_law(file)
    assert message in str(error.value)
    assert str(error.value).startswith(f"{file}: ")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", ":1:1: not readable as JSON: Expecting value"),
        (b'{"a": 1,\n "b": }', ":2:7: not readable as JSON: Expecting value"),
        (b'{"a": NaN}', ": not readable as JSON: NaN is not a finite number"),
        (b'{"a": 1, "a": 2}', ': not readable as JSON: duplicate key "a"'),
        (b"[" * 100000, ": not readable as JSON: nested too deeply"),
        (b'{"a": 1e999}', ": not readable as JSON: 1e999 is not a finite number"),
        (b'{"a": 1' + b"0" * 400 + b"}", f": not readable as JSON: 1{'0' * 400} is not a finite number"),
        (b"[]", ": not a law file: its content is not an object"),
        (b"\xff\xfe\x00", ":1:1: is not a UTF-8 text; it seems to be UTF-16 or UTF-32: save it as UTF-8"),
    ],
)
def test_files_that_are_no_law_files(tmp_path, content, message):
    file = tmp_path / "law.json"
    file.write_bytes(content)
    with pytest.raises(InputError) as error:
        read_law(file)
    assert str(error.value) == f"{file}{message}"


def test_a_file_cut_short_anywhere_is_refused_or_another(tmp_path, text):
    file = tmp_path / "law.json"
    for end in range(1, len(text) - 2, 997):
        file.write_text(text[:end])
        with pytest.raises(InputError):
            read_law(file)


def test_samples_are_the_law_on_an_even_grid(paper, tmp_path):
    law = paper.optimised.law
    lines = "".join(format_samples(law, 10.0)).splitlines()
    assert lines[0] == "t,qw,qx,qy,qz,wx,wy,wz,ax,ay,az,jx,jy,jz,segment,node"
    table = np.array([[float(c) for c in line.split(",")[:14]] for line in lines[1:]])
    np.testing.assert_allclose(np.diff(table[:-1, 0]), 0.1, atol=1e-12)
    assert table[-1, 0] == pytest.approx(law.duration, abs=1e-13)
    for order, columns in ((0, slice(1, 5)), (1, slice(5, 8)), (2, slice(8, 11)), (3, slice(11, 14))):
        np.testing.assert_allclose(
            table[:, columns], law(table[:, 0].clip(0, law.duration), order), atol=1e-10
        )
    (tmp_path / "samples.csv").write_text("\n".join(lines))
    assert len(read_table(tmp_path / "samples.csv")[0]) == len(table)


@pytest.mark.parametrize("rate", [1e-3, 1 / 28.82888225439081, 1.0, 7.3])
def test_samples_begin_and_end_with_the_motion(paper, rate):
    law = paper.optimised.law
    rows = [
        line.split(",") for line in "".join(format_samples(law, rate)).splitlines() if line[0] in "0123456789"
    ]
    assert float(rows[0][0]) == 0
    assert float(rows[-1][0]) == pytest.approx(law.duration, rel=1e-14)
    assert len(rows) >= 2


def test_too_many_samples_are_refused(paper):
    with pytest.raises(
        InputError,
        match=r"output\.rate: 28828[0-9]{5} rows in 28\.8289 s; at most 20000000 .* below 693000 Hz",
    ):
        format_samples(paper.optimised.law, 1e8)


def test_a_file_is_replaced_whole(tmp_path):
    path = tmp_path / "deep" / "law.json"
    write_text(path, "one")
    write_text(path, "två")
    assert path.read_text(encoding="utf-8") == "två"
    assert [p.name for p in path.parent.iterdir()] == ["law.json"]


def test_a_folder_that_cannot_be_made(tmp_path):
    (tmp_path / "taken").write_text("a file")
    with pytest.raises(InputError, match="cannot be written"):
        write_text(tmp_path / "taken" / "law.json", "text")


def test_labels_with_any_characters_survive(paper):
    first = paper.optimised.law.segments[0]
    law = replace(paper.optimised.law, segments=(replace(first, origin='a "b", ü\n<c>'),))
    assert from_document(json.loads(json.dumps(to_document(law)))).labels[0] == 'a "b", ü\n<c>'


def test_reference_laws_are_small():
    design = reference("paper-24-cell")
    assert len(format_law(design.optimised.law, design.optimised.certificate, {})) < 24_000
