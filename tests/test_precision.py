"""How precisely orientations are written: digits, single precision, norms; and the key that says so."""

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from tests.typed import WAYS, step, write
from timelaw.errors import InputError
from timelaw.orientations import read_orientations
from timelaw.orientations.precision import DOUBLES, EXACT, MATRICES, QUATERNIONS, measure_precision
from timelaw.orientations.table import read_table

SOME = unit_quaternions(np.random.default_rng(11), 40)


def measure(rows, form=QUATERNIONS):
    return measure_precision(np.array(rows, dtype=float), form)


def read(spec: str, folder: Path = Path()):
    return read_orientations(problem(f"route: {{orientations: {{{spec}}}}}").route.orientations, folder)


def turn_between(q, p):
    return (
        Rotation.from_quat(q, scalar_first=True).inv() * Rotation.from_quat(p, scalar_first=True)
    ).magnitude()


@pytest.mark.parametrize("way", WAYS)
def test_the_rounding_of_quaternions_is_covered_and_not_by_far(way):
    """No orientation is farther from what was meant; some come within a third of it."""
    for seed in range(40):
        q = unit_quaternions(np.random.default_rng(seed), 12)
        found = measure(write(q, way))
        off = np.max(turn_between(q, write(q, way)))
        assert off <= found.angle
        assert found.angle <= 2.6 * step(way), found
        assert off >= found.angle / 4


@pytest.mark.parametrize("digits", range(3, 13))
def test_the_rounding_of_matrices_is_covered_and_not_by_far(digits):
    for seed in range(10):
        rotations = Rotation.random(12, rng=np.random.default_rng(seed))
        rows = rotations.as_matrix().reshape(-1, 9).round(digits)
        found = measure(rows, MATRICES)
        off = np.max((rotations.inv() * Rotation.from_matrix(rows.reshape(-1, 3, 3))).magnitude())
        assert found.origin == f"matrices with {digits} digits"
        assert found.angle / 4 <= off <= found.angle


def test_digits_are_told():
    assert measure(SOME.round(4)).origin == "quaternions with 4 digits"
    assert measure(SOME.round(4)).angle == pytest.approx(2e-4, rel=2e-4)
    assert measure(write(SOME, "single")).origin == "quaternions in single precision"
    assert measure(write(SOME, "shortest single")).origin == "quaternions in single precision"
    assert measure(
        Rotation.from_quat(SOME).as_matrix().reshape(-1, 9).astype(np.float32), MATRICES
    ).origin == ("matrices in single precision")


EXACTLY = {
    "short numbers": [[1, 0, 0, 0], [0.5, 0.5, 0.5, 0.5], [0.6, 0.8, 0, 0], [-0.28, 0, 0.96, 0]],
    "full doubles": SOME,
    "both": [*SOME.tolist(), [0.6, 0.8, 0, 0]],
}


@pytest.mark.parametrize("rows", EXACTLY)
def test_what_is_exact(rows):
    assert measure(EXACTLY[rows]) is EXACT


def test_the_worst_row_counts():
    """Rows that happen to be right, or that are written in full, make those beside them no better."""
    typed = [[0.7071, 0.7071, 0, 0], [0.5774, 0, 0.5774, 0.5773]]
    for others in ([], EXACTLY["short numbers"], SOME.tolist(), SOME.round(7).tolist()):
        assert measure([*others, *typed]).origin == "quaternions with 4 digits", others
    assert measure([[0.6, 0.8, 0, 0], [0.9999, 0.0123, 0, 0]]).angle == pytest.approx(2e-4, rel=2e-4)


def test_trailing_zeros_and_ones_do_not_hide_digits():
    assert measure([[1.0, 0.0012, 0, 0], [1.0, 0.0034, 0, 0]]).origin == "quaternions with 4 digits"
    assert measure([[0.999, 0.0436, 0, 0], [0.9962, 0.0872, 0, 0]]).origin == "quaternions with 4 digits"


def test_norms_that_digits_do_not_explain():
    off = SOME * (1 + np.linspace(-1e-5, 1e-5, len(SOME)))[:, None]
    found = measure(off)
    assert found.origin == "quaternions whose norms are off by up to 1e-05"
    assert found.angle == pytest.approx(6e-5, rel=1e-3)
    assert measure([[0.70712345, 0.7071, 0, 0], [0.7072, 0.7076, 0, 0]]).angle > 2e-4


@pytest.mark.parametrize(
    "spec",
    [
        "lattice: 600-cell",
        "uniform: {fill: 60 deg}",
        "list: [[1.2, 0.3, 0], [7, 8, 9.1]], as: rotation-vector, unit: deg",
        "list: [[1.2, 0.3, 0], [7, 8, 9.1]], as: euler, sequence: ZYX, unit: deg",
    ],
)
def test_angles_and_lattices_are_exact_as_they_stand(spec):
    assert read(spec).precision is EXACT
    assert DOUBLES <= 1e-14


TYPED = "list: [[0.7071, 0.7071, 0, 0], [0.7071, 0, 0.7071, 0]]"


def test_the_key_overrides_what_the_digits_show():
    assert read(TYPED).precision.angle == pytest.approx(2e-4, rel=2e-4)
    for spec in (
        TYPED,
        "lattice: 24-cell",
        "list: [[1, 0, 0], [0, 1, 0]], as: euler, sequence: ZYX, unit: deg",
    ):
        given = read(f"{spec}, precision: 0.01 deg").precision
        assert given.angle == pytest.approx(np.radians(0.01))
        assert given.origin == "as given"


def test_frames_keep_it():
    turned = f"{TYPED}, turned: {{world: [0.6, 0.8, 0, 0]}}"
    assert read(turned).precision == read(TYPED).precision


def test_tables_show_it_too(tmp_path):
    (tmp_path / "a.csv").write_text("w,x,y,z\n0.7071,0.7071,0,0\n1,0,0,0\n")
    assert read("file: a.csv", tmp_path).precision.origin == "quaternions with 4 digits"
    assert read_table(tmp_path / "a.csv")[2].angle == pytest.approx(2e-4, rel=2e-4)
    rows = Rotation.from_quat(SOME).as_matrix().reshape(-1, 9).round(5)
    (tmp_path / "m.csv").write_text("\n".join(",".join(map(repr, row)) for row in rows.tolist()))
    assert read("file: m.csv, as: matrix", tmp_path).precision.origin == "matrices with 5 digits"


FAULTS = {
    "0.01": '"0.01" has no unit; write an angle like "20 deg"',
    "0.01 deg/s": '"0.01 deg/s" is not an angle; write it like "20 deg"',
    "20 deg": '"20 deg" is out of range; 1e-14 to 0.1 rad are allowed',
    "0 deg": '"0 deg" is out of range; 1e-14 to 0.1 rad are allowed',
}


@pytest.mark.parametrize("value", FAULTS)
def test_a_precision_that_is_none(value):
    with pytest.raises(InputError) as error:
        read(f"lattice: 24-cell, precision: {value}")
    assert str(error.value).endswith(f"route.orientations.precision: {FAULTS[value]}")


def test_the_key_is_among_those_allowed():
    with pytest.raises(InputError, match=r'unknown key "precison".*did you mean "precision"\?'):
        read("lattice: 24-cell, precison: 1 deg")


def test_duplicates_within_the_precision_are_duplicates():
    """0.0001 apart in four digits is nothing; 0.0004 apart is something."""
    rows = "[[0.7071, 0.7071, 0, 0], [0.7071, 0.7071, 0.0001, 0], [0.5774, 0.5774, 0.5773, 0], [0.5774, 0.577, 0.5777, 0]]"
    assert read(f"list: {rows}").same == (("1", "2"),)
    assert read(f"list: {rows}, duplicates: merge").labels == ("1", "3", "4")
    assert read(f"list: {rows}, precision: 1e-9 rad").same == ()
    assert read(f"list: {rows}, duplicates: merge, tolerance: 0.1 deg").labels == ("1", "3")
