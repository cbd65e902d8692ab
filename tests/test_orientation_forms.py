"""Every form in which orientations are written, against SciPy or matrices by hand; merging; faults."""

from math import cos, degrees, radians, sin
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from timelaw.errors import InputError
from timelaw.numerics.quaternion import rotation_matrix
from timelaw.orientations import read_orientations
from timelaw.pipeline import lay_out
from timelaw.tours import find_tour

RNG = np.random.default_rng(4)
SOME = unit_quaternions(RNG, 6)
ROTATIONS = Rotation.from_quat(SOME, scalar_first=True)


def read(spec: str, folder: Path = Path()):
    return read_orientations(problem(f"route: {{orientations: {{{spec}}}}}").route.orientations, folder)


def same(q, expected):
    """Equal up to sign."""
    assert q.shape == expected.shape
    np.testing.assert_allclose(np.abs(np.sum(q * expected, axis=1)), 1, atol=1e-12)


def about(axis: str, angle: float) -> np.ndarray:
    """The textbook matrix of an active turn about a coordinate axis."""
    c, s = cos(angle), sin(angle)
    return np.array(
        {
            "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
            "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
        }[axis]
    )


FORMS = {
    "as: wxyz": SOME,
    "as: xyzw": SOME[:, [1, 2, 3, 0]],
    "as: rotation-vector, unit: rad": ROTATIONS.as_rotvec(),
    "as: rotation-vector, unit: deg": ROTATIONS.as_rotvec(degrees=True),
    "as: matrix": ROTATIONS.as_matrix().reshape(-1, 9),
    "as: axis-angle, unit: deg": np.column_stack(
        [3 * ROTATIONS.as_rotvec(), np.degrees(np.linalg.norm(ROTATIONS.as_rotvec(), axis=1))]
    ),
    "as: euler, sequence: ZYX, unit: deg": ROTATIONS.as_euler("ZYX", degrees=True),
    "as: euler, sequence: xyz, unit: rad": ROTATIONS.as_euler("xyz"),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("where", ["list", "plain file", "tabs and names"])
def test_forms(form, where, tmp_path):
    rows = FORMS[form]
    if where == "list":
        return same(read(f"list: {rows.tolist()}, {form}").quaternions, SOME)
    separator = "," if where == "plain file" else "\t"
    text = "\n".join(separator.join(map(repr, map(float, row))) for row in rows)
    names = [f"col{i}" for i in range(rows.shape[1])]
    columns = f", columns: [{', '.join(names)}]" if where != "plain file" else ""
    if columns:
        text = separator.join(names).upper() + "\n" + text
    (tmp_path / "scan.txt").write_text(text)
    return same(read(f"file: scan.txt, {form}{columns}", tmp_path).quaternions, SOME)


def test_capitals_turn_with_the_body_and_small_letters_about_fixed_axes():
    angles = [30.0, -50.0, 110.0]
    a, b, c = map(radians, angles)
    for sequence, expected in (
        ("ZYX", about("z", a) @ about("y", b) @ about("x", c)),
        ("zyx", about("x", c) @ about("y", b) @ about("z", a)),
    ):
        q = read(f"list: [{angles}, [0, 0, 0]], as: euler, sequence: {sequence}, unit: deg").quaternions
        np.testing.assert_allclose(rotation_matrix(q[0]), expected, atol=1e-12)


def test_matrices_may_be_three_rows():
    q = read("list: [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, -1, 0], [1, 0, 0], [0, 0, 1]]], as: matrix")
    np.testing.assert_allclose(q.quaternions[1], [0.5**0.5, 0, 0, 0.5**0.5], atol=1e-12)


def test_default_column_names(tmp_path):
    header = ",".join(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))
    rows = ROTATIONS.as_matrix().reshape(-1, 9)
    text = "label," + header + "\n"
    text += "\n".join(f"p{i}," + ",".join(repr(float(v)) for v in row) for i, row in enumerate(rows))
    (tmp_path / "m.csv").write_text(text)
    found = read("file: m.csv, as: matrix", tmp_path)
    same(found.quaternions, SOME)
    assert found.labels == tuple(f"p{i}" for i in range(6))


BUNGE = [(10.0, 20.0, 30.0), (200.0, 95.0, 310.0)]
ATTITUDES = [about("z", radians(a)) @ about("x", radians(b)) @ about("z", radians(c)) for a, b, c in BUNGE]


def test_ang_files(tmp_path):
    rows = [" ".join(f"{radians(v):.12f}" for v in row) + " 0.0 0.0 50.1 0.9 1" for row in BUNGE]
    rows.insert(1, "12.56637 12.56637 12.56637 0 1 0 -1 0")
    (tmp_path / "map.ang").write_text("# TEM_PIXperUM 1.0\n# GRID: SqrGrid\n" + "\n".join(rows) + "\n")
    found = read("file: map.ang", tmp_path)
    np.testing.assert_allclose(rotation_matrix(found.quaternions), ATTITUDES, atol=1e-10)
    assert found.notes == ("1 points of map.ang were not indexed and are left out",)


def test_ctf_files(tmp_path):
    head = "Channel Text File\nPrj\tscan\nEuler angles refer to Sample Coordinate system (CS0)!\tMag\t100\nPhases\t1\n"
    names = "Phase\tX\tY\tBands\tError\tEuler1\tEuler2\tEuler3\tMAD\tBC\tBS\n"
    rows = [f"1\t0\t{i}\t8\t0\t{a}\t{b}\t{c}\t0.4\t90\t80" for i, (a, b, c) in enumerate(BUNGE)]
    rows.insert(1, "0\t0\t9\t0\t3\t0\t0\t0\t0\t60\t0")
    (tmp_path / "map.ctf").write_text(head + names + "\n".join(rows))
    found = read("file: map.ctf", tmp_path)
    np.testing.assert_allclose(rotation_matrix(found.quaternions), ATTITUDES, atol=1e-12)
    assert found.labels == ("1", "3")


def test_frames_turn_before_and_after():
    world, body = Rotation.from_euler("xyz", [10, 20, 30], degrees=True), Rotation.from_rotvec([0, 0, 1.2])
    a, b = (r.as_quat(scalar_first=True).tolist() for r in (world, body))
    found = read(f"list: {SOME.tolist()}, turned: {{world: {a}, body: {b}}}")
    same(found.quaternions, (world * ROTATIONS * body).as_quat(scalar_first=True))


def test_a_turned_lattice_keeps_its_numbering_and_the_papers_tour():
    turned = "lattice: 24-cell, turned: {world: [0.6, 0.8, 0, 0]}"
    plain, found = read("lattice: 24-cell"), read(turned)
    expected = Rotation.from_quat([0.8, 0, 0, 0.6]) * Rotation.from_quat(plain.quaternions, scalar_first=True)
    same(found.quaternions, expected.as_quat(scalar_first=True))
    made = problem(f"route: {{orientations: {{{turned}}}, tour: paper}}")
    assert find_tour(made, found).is_shortest


REPEATED = "list: [[1,0,0,0], [0,1,0,0], [-1,0,0,0], [0,-1,0,0], [0,0,1,0]]"


def test_duplicates_up_to_sign_are_found_and_merged_when_asked():
    assert read(REPEATED).same == (("1", "3"), ("2", "4"))
    merged = read(f"{REPEATED}, duplicates: merge")
    assert merged.labels == ("1", "2", "5")
    assert merged.notes == ("2 of 5 orientations are merged: 3 is 1, 4 is 2",)
    assert merged.same == ()


def test_nearly_the_same_is_the_same_within_a_tolerance():
    near = [cos(radians(0.05)), sin(radians(0.05)), 0, 0]  # 0.1° away
    spec = f"list: [[1,0,0,0], {near}, [0,0,1,0]], duplicates: merge"
    assert len(read(spec)) == 3
    assert len(read(f"{spec}, tolerance: 0.09 deg")) == 3
    assert read(f"{spec}, tolerance: 0.11 deg").labels == ("1", "3")


@pytest.mark.parametrize(
    ("group", "size"), [("432", 24), ("m-3m", 24), ("23", 12), ("622", 12), ("-3m", 6), ("4", 4), ("D5", 10)]
)
def test_equivalents_of_a_crystal_are_merged(group, size):
    from timelaw.orientations.equivalence import make_rotation_group

    turns = Rotation.from_quat(make_rotation_group(group), scalar_first=True)
    assert len(turns) == size
    every = [(r * turn).as_quat(scalar_first=True).tolist() for r in ROTATIONS[:3] for turn in turns]
    found = read(f"list: {every}, symmetry: '{group}'")
    same(found.quaternions, (ROTATIONS[:3] * turns[0]).as_quat(scalar_first=True))
    assert found.notes[0].startswith(f"{3 * size - 3} of {3 * size} orientations are merged under {group}")


def test_the_24_cell_is_one_orientation_of_a_crystal_of_class_23():
    """The 24-cell is the rotation group 23 itself, so under it all twelve are one."""
    with pytest.raises(InputError, match="all orientations are the same"):
        read("lattice: 24-cell, symmetry: '23'")
    assert len(read("lattice: 600-cell, symmetry: '23'")) == 5


HEAD = "timelaw: 1\nname: scan\nroute:\n  orientations: {"
TAIL = "}\nlimits: {velocity: 60 deg/s}\n"
FAULTS = {
    "list: [[1, 0, 0, 0], [1, 0, 0]]": "4:39: route.orientations.list[2]: expected a quaternion of four numbers [w, x, y, z]",
    "list: [[1, 0, 0, 0], [1, 1, 0, 0]]": "4:39: route.orientations.list[2]: [1, 1, 0, 0] has norm 1.41421; a unit quaternion [w, x, y, z] is needed",
    "list: [[0, 0, 0, 1], [1, 0, 1, 0]], as: xyzw": "4:39: route.orientations.list[2]: [1, 0, 1, 0] has norm 1.41421; a unit quaternion [x, y, z, w] is needed",
    "list: [[1, 0], [0, 1]], as: rotation-vector, unit: deg": "4:25: route.orientations.list[1]: expected a rotation vector of three numbers",
    "list: [[1,0,0,0,1,0,0,0,1], [1,0,0,0,1,0,0,0,2]], as: matrix": "4:46: route.orientations.list[2]: not a rotation matrix: RᵀR differs from 1 by 3",
    "list: [[1,0,0,0,1,0,0,0,1], [1,0,0,0,1,0,0,0,-1]], as: matrix": "4:46: route.orientations.list[2]: not a rotation matrix: its determinant is -1",
    "list: [[1, 0, 0], [0, 1, 0]], as: euler, unit: deg": '4:52: route.orientations.as: "as: euler" needs "sequence"',
    "list: [[1, 0, 0], [0, 1, 0]], as: rotation-vector": '4:52: route.orientations.as: "as: rotation-vector" needs "unit"',
    "list: [[1, 0, 0], [0, 1, 0]], as: euler, unit: deg, sequence: XXY": '4:80: route.orientations.sequence: "XXY"; two turns in a row about one axis are one turn',
    "list: [[1, 0, 0, 0], [0, 1, 0, 0]], unit: deg": '4:60: route.orientations.unit: it belongs to "as: rotation-vector or euler or axis-angle"',
    "lattice: 24-cell, as: xyzw": '4:40: route.orientations.as: it describes what a "file" or "list" holds',
    "lattice: 24-cell, columns: [a]": '4:45: route.orientations.columns: it describes what a "file" holds',
    "lattice: 600-cell, symmetry: m3m": '4:47: route.orientations.symmetry: "m3m"; allowed: 1, -1, 2, 2/m, 222, mmm, 4, 4/m, 422, 4/mmm, 3, -3, 32, -3m, 6, 6/m, 622, 6/mmm, 23, m-3, 432, m-3m, or I, O, T, C1 to C12, D1 to D12; did you mean "m-3m"?',
    "lattice: 24-cell, turned: {world: [1, 1, 0, 0]}": "4:52: route.orientations.turned.world: expected a unit quaternion [w, x, y, z]",
    "list: [[1, 0, 0], [0, 1, 0]], as: euler, unit: deg, sequence: ZxZ": '4:80: route.orientations.sequence: "ZxZ"; three of X, Y, Z, which turn with the body, or three of x, y, z about fixed axes are needed',
    "list: [[[1,0,0,0],[1,0],[0,0,1]], [[1,0,0],[0,1,0],[0,0,1]]], as: matrix": "4:25: route.orientations.list[1]: a matrix has three rows of three numbers, or with a translation three or four of four",
    "file: a.ang, columns: [a, b, c]": '4:40: route.orientations.columns: .ang files have their own columns; give "as" too, or leave "columns" away',
    "file: a.csv, columns: [w, w, y, z]": "4:40: route.orientations.columns: as many different names as the form has numbers are needed",
    "uniform: {fill: 20}": '4:34: route.orientations.uniform.fill: "20" has no unit; write an angle like "20 deg"',
    "uniform: {fill: 5 deg}": "4:34: route.orientations.uniform.fill: 5° needs more than 5000 orientations, which reach 13.14°",
    "list: [[1, 0, 0, 0], [-1, 0, 0, 0]], duplicates: merge": "4:17: route.orientations: all orientations are the same; at least two are needed",
}


@pytest.mark.parametrize("spec", FAULTS)
def test_faults_have_their_place(spec, tmp_path):
    path = tmp_path / "scan.yaml"
    path.write_text(HEAD + spec + TAIL)
    with pytest.raises(InputError) as error:
        lay_out(path)
    assert str(error.value) == f"{path}:{FAULTS[spec]}"


FILES = {
    "a.ang": ("# nothing\n0.1 0.2\n", "{path}:2:1: 2 values; phi1, Phi, phi2 are needed"),
    "b.ang": ("0.1 0.2 x\n", '{path}:1:1: "x" is not a number'),
    "c.ang": ("0.1 0.2 0.3\n", "{path}: 1 indexed points; at least two are needed"),
    "d.ctf": ("Channel Text File\n", "{path}: no line names the columns Phase, Euler1, Euler2, Euler3"),
    "e.ctf": ("Phase\tEuler1\tEuler2\tEuler3\n1\t2\n", "{path}:2:1: 2 values; 4 are needed"),
}


@pytest.mark.parametrize("name", FILES)
def test_faults_of_angle_files(name, tmp_path):
    text, message = FILES[name]
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError) as error:
        read(f"file: {name}", tmp_path)
    assert str(error.value) == message.format(path=tmp_path / name)


@pytest.mark.parametrize("number", ["1e999", "-1e12"])
@pytest.mark.parametrize("form", ["rotation-vector, unit: rad", "euler, unit: deg, sequence: ZYX", "matrix"])
def test_numbers_that_cannot_be_reckoned_with(number, form, tmp_path):
    rest = ",0" * (8 if form == "matrix" else 2)
    (tmp_path / "a.csv").write_text(f"{number}{rest}\n0{rest}\n")
    with pytest.raises(
        InputError, match=rf'a\.csv:1:1: "{number}" is out of range; 1e\+09 at most is allowed'
    ):
        read(f"file: a.csv, as: {form}", tmp_path)


def test_merging_does_not_go_on_from_one_that_is_left_out():
    vectors = [[0, 0, a] for a in (0, 2, 4, 6, 90)]
    spec = f"list: {vectors}, as: rotation-vector, unit: deg, duplicates: merge, tolerance: 2.5 deg"
    assert read(spec).labels == ("1", "3", "5")
    assert read(spec).notes == ("2 of 5 orientations are merged: 2 is 1, 4 is 3",)


def test_a_crystal_class_may_look_like_a_number():
    assert len(read("lattice: 600-cell, symmetry: 23")) == 5


def test_names_of_columns_must_be_as_many_as_numbers(tmp_path):
    (tmp_path / "a.csv").write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match=r"route\.orientations\.columns: 2 names; 4 are needed"):
        read("file: a.csv, as: xyzw, columns: [a, b]", tmp_path)


def nearest(q, p):
    """Rotation angles [deg] from each of p to the nearest of q."""
    return [degrees(2 * np.arccos(min(1.0, np.max(np.abs(q @ one))))) for one in p]


@pytest.mark.parametrize(("fill", "count"), [(120, 4), (90, 12), (60, 60), (45, 60)])
def test_coarse_uniform_sets_are_lattices(fill, count):
    found = read(f"uniform: {{fill: {fill} deg}}")
    assert len(found) == count
    assert found.lattice is not None


@pytest.mark.parametrize("fill", [40, 25])
def test_fine_uniform_sets_fill_as_they_say(fill):
    """No random orientation is farther away, some come near; separation by all pairs."""
    found = read(f"uniform: {{fill: {fill} deg}}")
    text = found.notes[0]
    measured = float(text.split("covering radius ")[1].removesuffix("°"))
    farthest = max(nearest(found.quaternions, unit_quaternions(RNG, 20_000)))
    assert 0.9 * measured < farthest < measured + 0.005
    assert measured <= fill + 0.005
    cosines = np.abs(found.quaternions @ found.quaternions.T) - 2 * np.eye(len(found))
    closest = degrees(2 * np.arccos(np.max(cosines)))
    assert f"separation {closest:.2f}°" in text


@pytest.mark.parametrize(
    ("name", "fill"),
    [("16-cell", 120), ("tesseract", 120), ("24-cell", 90), ("600-cell", 44.47751218592993)],
)
def test_covering_radii_of_the_lattices(name, fill):
    """Twice the circumradius of the cells: 60° of the 16-cell's tetrahedra and the tesseract's cubes,

    45° of the octahedra, and arccos(φ²/√8) = 22.2388° of the 600-cell's tetrahedra.
    """
    from timelaw.orientations.lattices import make_lattice
    from timelaw.orientations.spread import measure_covering_radius, measure_separation

    assert degrees(measure_covering_radius(make_lattice(name))) == pytest.approx(fill, abs=1e-9)
    assert degrees(measure_separation(make_lattice(name))) == pytest.approx(
        {"16-cell": 180, "tesseract": 120, "24-cell": 120, "600-cell": 72}[name], abs=1e-6
    )
