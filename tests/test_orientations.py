"""The five lattices against the counts and distances of SOURCES, and tables."""

from collections import Counter
from math import acos, degrees, sqrt
from pathlib import Path

import numpy as np
import pytest

from tests.cases import problem
from timelaw.errors import InputError
from timelaw.orientations import OrientationSet, read_orientations
from timelaw.orientations.lattices import LATTICES, make_lattice
from timelaw.orientations.table import read_table

PAPER = """1 0 0 0 / 0 1 0 0 / 0 0 1 0 / 0 0 0 1 / .5 .5 .5 .5 / .5 -.5 .5 .5 / .5 .5 -.5 .5 / .5 .5 .5 -.5
 / .5 -.5 -.5 .5 / .5 .5 -.5 -.5 / .5 -.5 .5 -.5 / .5 -.5 -.5 -.5"""
PHI = (1 + sqrt(5)) / 2
# name: orientations, cos of the least arc on S³ (half edge of the polytope), nearest neighbours on SO(3)
FACTS = {
    "16-cell": (4, 0.0, 3),
    "tesseract": (8, 0.5, 4),
    "24-cell": (12, 0.5, 8),
    "600-cell": (60, PHI / 2, 12),
    "120-cell": (300, (1 + 3 * sqrt(5)) / 8, 4),
}


@pytest.mark.parametrize("name", FACTS)
def test_counts_norms_distances_and_neighbours(name):
    count, cosine, neighbours = FACTS[name]
    q = make_lattice(name)
    assert q.shape == (count, 4)
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=3e-16)
    gram = np.abs(q @ q.T) - 2 * np.eye(count)
    assert np.max(gram) == pytest.approx(cosine, abs=1e-12)
    assert set(np.sum(gram > cosine - 1e-9, axis=1)) == {neighbours}


def test_the_registry_is_what_the_problem_file_allows():
    assert list(LATTICES) == list(FACTS)


@pytest.mark.parametrize("name", ["tesseract", "600-cell", "120-cell"])
def test_the_documented_order_and_representatives(name):
    q = make_lattice(name)
    rows = [tuple(np.round(row, 9) + 0.0) for row in q]
    assert rows == sorted(rows, reverse=True)
    assert all(next(c for c in row if c != 0) > 0 for row in rows)


def test_the_24_cell_is_numbered_as_in_the_paper():
    expected = [[float(c) for c in row.split()] for row in PAPER.split("/")]
    np.testing.assert_array_equal(make_lattice("24-cell"), expected)


def test_table_1_of_the_paper():
    """Arc lengths without absolute value: 12 zeros, 32 pairs at 60°, 18 at 90°, 16 at 120°; 78 entries."""
    q = make_lattice("24-cell")
    upper = [round(degrees(acos(np.clip(q[i] @ q[j], -1, 1)))) for i in range(12) for j in range(i, 12)]
    assert Counter(upper) == {0: 12, 60: 32, 90: 18, 120: 16}
    on_so3 = np.abs(q @ q.T)[np.triu_indices(12, 1)]
    assert np.sum(np.isclose(on_so3, 0.5)) == 48


@pytest.mark.parametrize("name", ["24-cell", "600-cell"])
def test_closure_under_multiplication(name):
    """The vertices of these two are groups: a rotation of one by another is a third."""
    from scipy.spatial.transform import Rotation

    q = make_lattice(name)
    products = (
        Rotation.from_quat(q[5], scalar_first=True) * Rotation.from_quat(q, scalar_first=True)
    ).as_quat(scalar_first=True)
    assert np.all(np.max(np.abs(products @ q.T), axis=1) > 1 - 1e-12)


def write(folder: Path, text: str) -> Path:
    path = folder / "scan.csv"
    path.write_text(text)
    return path


def test_a_table_is_read_by_its_column_names(tmp_path):
    text = "# a scan\nlabel, z, y, x, w\nhome,0,0,0,1\n\nup,0,0,0.6,0.8\n"
    q, labels, *_ = read_table(write(tmp_path, text))
    np.testing.assert_allclose(q, [[1, 0, 0, 0], [0.8, 0.6, 0, 0]])
    assert labels == ("home", "up")


def test_labels_may_hold_anything(tmp_path):
    text = 'label,w,x,y,z\n"#1",1,0,0,0\n"two\nlines",0,1,0,0\n[/a] $\\frac$,0,0,1,0\n'
    assert read_table(write(tmp_path, text))[1] == ("#1", "two\nlines", "[/a] $\\frac$")


def test_a_table_is_found_beside_the_problem_file(tmp_path):
    write(tmp_path, "qw,qx,qy,qz\n1,0,0,0\n0.7071,0.7071,0,0\n")
    points = read_orientations(
        problem("route: {orientations: {file: scan.csv}}").route.orientations, tmp_path
    )
    assert points.labels == ("1", "2")
    np.testing.assert_allclose(np.linalg.norm(points.quaternions, axis=1), 1, atol=1e-16)
    with pytest.raises(ValueError, match="read-only"):
        points.quaternions[0, 0] = 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no rows; a header w,x,y,z and a row per orientation are needed"),
        (
            "1,0,0,0\n0,1,0,0\n",
            ":1:1: the header has 1, 0, 0, 0; columns w, x, y, z (or qw, qx, qy, qz) are needed",
        ),
        ("w,x,y,z\n1,0,0,0\n", "1 orientations; at least two are needed"),
        ("w,x,y,z\n1,0,0,0\n1,0,0\n", ":3:1: 3 values; 4 are needed"),
        (
            "w,x,y,z\n1,0,0,0\n1,0,zero,0\n",
            ':3:1: "zero" is not a number',
        ),
        (
            "w,x,y,z\n1,0,0,0\n1,1,0,0\n",
            ":3:1: [1, 1, 0, 0] has norm 1.41421; a unit quaternion [w, x, y, z] is needed",
        ),
        ("w,x,y,z\n1,0,0,0\nnan,1,0,0\n", ':3:1: "nan" is not a number'),
        ("w,x,y,z,label\n1,0,0,0,a\n0,1,0,0,a\n", ':3:1: label "a" stands in line 2 too'),
        ("w,x,y,z,label\n1,0,0,0,a\n0,1,0,0,\n", ":3:1: no label"),
        ("w,x,y,z,w\n1,0,0,0,1\n", ':1:1: the header names "w" more than once'),
        ("w,x,y,z\n1,0,0,0\n1_0e-1,0,0,0\n", ':3:1: "1_0e-1" is not a number'),
        ('w,x,y,z,label\n1,0,0,0,"a\n0,1,0,0,b\n', ":3:1: not readable as CSV: unexpected end of data"),
    ],
)
def test_malformed_tables(tmp_path, text, message):
    path = write(tmp_path, text)
    with pytest.raises(InputError) as error:
        read_table(path)
    separator = "" if message.startswith(":") else ": "
    assert str(error.value) == f"{path}{separator}{message}"


def test_a_missing_table(tmp_path):
    with pytest.raises(InputError, match=r"scan\.csv: cannot be read: No such file or directory"):
        read_table(tmp_path / "scan.csv")


def test_a_set_leaves_its_callers_array_as_it_is():
    mine = np.eye(4)
    points = OrientationSet(mine, tuple("abcd"), "list")
    mine[0] = 7.0
    assert points.quaternions[0, 0] == 1.0
    assert not points.quaternions.flags.writeable
