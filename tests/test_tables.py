"""Tables of orientations: what could be read in two ways is refused, and rows keep their numbers."""

import random
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem
from timelaw.errors import InputError
from timelaw.orientations import read_orientations
from timelaw.orientations.angle_files import READERS
from timelaw.problem.route import ANGLE_FILES

DEGREES = [[10.5, 20.0, 30.25], [200.0, 95.0, 310.0], [-40.0, 5.5, 77.0]]
EXPECTED = Rotation.from_euler("ZXZ", DEGREES, degrees=True).as_quat(scalar_first=True)
EULER = "as: euler, sequence: ZXZ, unit: deg"
QUATERNIONS = [[0.6, 0.8, 0, 0], [0, 0.6, 0.8, 0], [1, 0, 0, 0]]


def read(spec: str, folder: Path, text: str, name: str = "scan.csv"):
    (folder / name).write_text(text, newline="")
    made = problem(f"route: {{orientations: {{file: {name}, {spec}}}}}")
    return read_orientations(made.route.orientations, folder)


def table(*more, rows=DEGREES, sep=",", header=None):
    """Rows of numbers, each after a number of its own and before others."""
    lines = [sep.join(map(str, [*more[:1], *row, *more[1:]])) for row in rows]
    return "\n".join([*([header] if header else []), *lines]) + "\n"


def same(found, expected=EXPECTED):
    np.testing.assert_allclose(np.abs(np.sum(found.quaternions * expected, axis=1)), 1, atol=1e-12)
    assert found.labels == ("1", "2", "3")


GOOD = {
    "just its columns": (table(), ""),
    "an empty last column": (table().replace("\n", ",\n"), ""),
    "numbers": (table(7, 1.5), ", columns: [2, 3, 4]"),
    "numbers and a header": (table(7, 1.5, header="id,a,b,c,d"), ", columns: [2, 3, 4]"),
    "names": (table(7, 1.5, header="id,a,b,c,d"), ", columns: [A, b, c]"),
    "usual names": (table(7, 1.5, header="id, phi1, PHI, phi2, mad"), ""),
    "names that are numbers": (table(header="0,1,2"), ', columns: ["0", "1", "2"]'),
    "semicolons": (table(7, sep=";"), ", columns: [2, 3, 4]"),
    "fixed width": ("".join(f"{a:9.2f}{b:9.2f}{c:9.2f}  \n" for a, b, c in DEGREES), ""),
    "tabs at the end": (table(sep="\t").replace("\n", "\t\n"), ""),
    "quotes": (re.sub(r"[-\d.]+", r'"\g<0>"', table()), ""),
    "a byte order mark": ("\ufeff" + table(), ""),
    "lines of other systems": (table().replace("\n", "\r\n"), ""),
    "lines of old systems": (table().replace("\n", "\r"), ""),
    "comments before, empty lines, blanks at the end": ("# scan\n\n" + table().replace("\n", "\n\n") + "  \n", ""),
}  # fmt: skip


@pytest.mark.parametrize("case", GOOD)
def test_tables_that_can_be_read_in_one_way(case, tmp_path):
    text, columns = GOOD[case]
    same(read(EULER + columns, tmp_path, text))


def test_columns_may_stand_in_any_order(tmp_path):
    rows = [[q[3], q[0], q[2], q[1]] for q in QUATERNIONS]
    for text in (table(rows=rows), table(rows=rows, header="a,b,c,d")):
        same(read("as: wxyz, columns: [2, 4, 3, 1]", tmp_path, text), np.array(QUATERNIONS))


REFUSED = {
    "more columns": (EULER, table(7), ":1:1: 4 columns and no header; 3 are needed for three Euler angles: name them, or give columns: [2, 3, 4], counted from 1"),
    "more after them": ("as: wxyz", table(rows=[[*q, 5.5] for q in QUATERNIONS]), ":1:1: 5 columns and no header; 4 are needed for a quaternion of four numbers [w, x, y, z]: name them, or give columns: [2, 3, 4, 5], counted from 1"),
    "a column that begins later": (EULER, table() + "1,2,3,4\n", ":4:1: 4 values; 3 are needed, with decimal points"),
    "homogeneous by columns": ("as: matrix", "1,0,0,0,0,1,0,0,0,0,1,0,.1,.2,.3,1\n" * 2, ":1:1: the last row of a 4x4 matrix is 0, 0, 0, 1, not 0.1, 0.2, 0.3, 1; is it written by columns? Then transpose it"),
    "fewer columns": (EULER, "1,2\n3,4\n", ":1:1: 2 values; 3 are needed"),
    "a short row": (EULER, table() + "1,2\n", ":4:1: 2 values; 3 are needed"),
    "a short row under names": (EULER, table(7, header="id,phi1,phi,phi2") + "1,2,3\n", ":5:1: 3 values; 4 are needed"),
    "a long row under names": (EULER, table(header="phi1,phi,phi2") + "1,2,3,4\n", ":5:1: 4 values; 3 are needed, with decimal points"),
    "decimal commas": (EULER, "0,5, 20,5, 3,5\n" * 2, ":1:1: 6 columns and no header; 3 are needed for three Euler angles: name them, or give columns: [4, 5, 6], counted from 1"),
    "decimal commas under names": (EULER, "phi1,phi,phi2\n" + "0,5, 20,5, 3,5\n", ":2:1: 6 values; 3 are needed, with decimal points"),
    "decimal commas and semicolons": (EULER, "0,5;20,5;3,5\n" * 2, ":1:1: the header has 0,5, 20,5, 3,5; columns euler1, euler2, euler3 (or phi1, phi, phi2) (or e1, e2, e3) are needed"),
    "decimal commas below": (EULER, "5;20;3\n0,5;20,5;3,5\n", ':2:1: "0,5" is not a number; a decimal point is needed'),
    "numbered columns": (EULER, table(header="0,1,2"), ':1:1: 0, 1, 2 may be numbers of columns or an orientation: give columns: ["0", "1", "2"], or columns: [1, 2, 3]'),
    "a label before": (EULER, table("home"), ":1:1: the header has home, 10.5, 20.0, 30.25; columns euler1, euler2, euler3 (or phi1, phi, phi2) (or e1, e2, e3) are needed; without a header give columns: [2, 3, 4], counted from 1"),
    "half a header": (f"{EULER}, columns: [1, 2, 3]", table(header="a,b,7"), ':1:1: columns [1, 2, 3] of the first row are a, b, 7: "7" is no name of a column, and not all of them are numbers'),
    "a missing number first": (f"{EULER}, columns: [1, 2, 3]", "nan,nan,nan\n" + table(), ':1:1: columns [1, 2, 3] of the first row are nan, nan, nan: "nan" is no name of a column, and not all of them are numbers'),
    "two sets of names": ("as: wxyz", table(rows=[[*q, *q] for q in QUATERNIONS], header="w,x,y,z,qw,qx,qy,qz"), ':1:1: the header has w, x, y, z and qw, qx, qy, qz; choose by the key "columns"'),
    "a name twice": (EULER, table(7, header="phi1,phi1,phi,phi2"), ':1:1: the header names "phi1" more than once'),
    "separators alone": (EULER, table() + ",,\n" + table(), ":4:1: an empty row; fill it in or take it out, for rows are numbered"),
    "separators at the end": (EULER, table() + ",,\n", ":4:1: an empty row; fill it in or take it out, for rows are numbered"),
    "blanks alone": (EULER, table() + "   \n" + table(), ":4:1: an empty row; fill it in or take it out, for rows are numbered"),
    "blanks in a table of blanks": (EULER, table(sep=" ") + "   \n" + table(sep=" "), ":4:1: an empty row; fill it in or take it out, for rows are numbered"),
    "a comment in between": (EULER, table() + "#1,2,3\n", ":4:1: comments stand before the first row; a label that starts with # needs quotes"),
    "no such column": (f"{EULER}, columns: [2, 3, 9]", table(), "route.orientations.columns: 9; scan.csv has 3 columns"),
    "too few numbers": (f"{EULER}, columns: [2, 3]", table(), "route.orientations.columns: 2 numbers; 3 are needed"),
    "w last": ("as: wxyz, columns: [qx, qy, qz, qw]", table(rows=QUATERNIONS, header="qx,qy,qz,qw"), 'route.orientations.columns: qx, qy, qz, qw is another order than w, x, y, z; as: xyzw, or order "columns" so'),
    "w last by number": ("as: wxyz, columns: [1, 2, 3, 4]", table(rows=QUATERNIONS, header="x,y,z,w"), 'route.orientations.columns: x, y, z, w is another order than w, x, y, z; as: xyzw, or order "columns" so'),
    "a huge number": (EULER, table() + "1,2,1" + "0" * 400 + "\n", f':4:1: "1{"0" * 400}" is out of range; 1e+09 at most is allowed'),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_tables_that_could_be_read_in_two_ways(case, tmp_path):
    spec, text, message = REFUSED[case]
    with pytest.raises(InputError) as error:
        read(spec, tmp_path, text)
    place = str(tmp_path / "scan.csv") if message.startswith(":") else ""
    assert str(error.value) == place + message


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ("[0, 1, 2]", "[0, 1, 2]; columns are counted from 1"),
        ("[1, 2, 2]", "as many different columns as the form has numbers are needed"),
        ("[1, 2, b]", "names of columns, or their numbers counted from 1, are needed"),
        ("[1, 2, true]", "names of columns, or their numbers counted from 1, are needed"),
        ("[1, 2, 3.0]", "names of columns, or their numbers counted from 1, are needed"),
        (f"[1, 2, 1{'0' * 200}]", f"[1, 2, 1{'0' * 200}]; columns are counted from 1"),
        ("3", "3; a list is needed"),
    ],
)
def test_columns_are_names_or_numbers(columns, message, tmp_path):
    with pytest.raises(InputError, match=re.escape(f"route.orientations.columns: {message}")):
        read(f"{EULER}, columns: {columns}", tmp_path, table())


def test_numbers_of_columns_need_a_form(tmp_path):
    with pytest.raises(InputError, match='numbers of columns do not say what is in them; give "as" too'):
        read("columns: [1, 2, 3, 4]", tmp_path, table(rows=QUATERNIONS))


def test_labels_stand_beside_numbered_columns(tmp_path):
    text = "label,a,b,c\n" + "\n".join(f'"#{i}",{a},{b},{c}' for i, (a, b, c) in enumerate(DEGREES))
    assert read(f"{EULER}, columns: [2, 3, 4]", tmp_path, text).labels == ("#0", "#1", "#2")


@pytest.mark.parametrize("unit", ["rad", "deg"])
@pytest.mark.parametrize("kind", ["ang", "ctf"])
def test_the_unit_of_an_angle_file_may_be_given(kind, unit, tmp_path):
    angles = np.radians(DEGREES) if unit == "rad" else np.array(DEGREES)
    rows = [" ".join(f"{v:.12g}" for v in row) + " 0 0 9 0.9" for row in angles]
    text = "\n".join(rows) + "\n"
    if kind == "ctf":
        tabs = [f"1\t{row}".replace(" ", "\t") for row in rows]
        text = "\n".join(["Phase\tEuler1\tEuler2\tEuler3\tX\tY\tBC\tMAD", *tabs])
    same(read(f"unit: {unit}", tmp_path, text, f"map.{kind}"))
    if (kind, unit) in (("ang", "rad"), ("ctf", "deg")):
        same(read("turned: {}", tmp_path, text, f"map.{kind}"))


def test_the_model_knows_the_kinds_of_angle_files():
    assert set(READERS) == set(ANGLE_FILES)


def test_an_angle_file_in_degrees_is_no_file_in_radians(tmp_path):
    text = "# x\n0.1 0.2 0.3\n10 20 30\n"
    with pytest.raises(InputError) as error:
        read("turned: {}", tmp_path, text, "map.ang")
    assert (
        str(error.value)
        == f"{tmp_path / 'map.ang'}:3:1: 30 rad is more than two turns; in degrees? unit: deg"
    )


def test_a_unit_that_is_given_is_believed(tmp_path):
    """A rate table turns on and on: three turns about x are no mistake where radians are asked for."""
    text = "# x\n0.1 0.2 0.3\n10 20 30\n"
    assert len(read("unit: rad", tmp_path, text, "map.ang")) == 2
    assert len(read("as: rotation-vector, unit: rad", tmp_path, "0,0,0\n20,0,0\n", "scan.csv")) == 2


@pytest.mark.parametrize(
    "mark", ["12.56637 12.56637 12.56637 0 0 0 -1", "12.566 12.566 12.566 0 0 0 0", "1 1 1 0 0 0 -1"]
)
def test_points_that_were_not_indexed_keep_their_number(mark, tmp_path):
    text = f"{mark}\n0.1 0.2 0.3 0 0 9 0.9\n{mark}\n0.4 0.2 0.3 0 0 9 0\n"
    found = read("turned: {}", tmp_path, text, "map.ang")
    assert found.labels == ("2", "4")
    assert found.notes == ("2 points of map.ang were not indexed and are left out",)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.ang", "1 2 3\n  \n2 3 4\n", ":2:1: an empty row; fill it in or take it out, for rows are numbered"),
        ("a.ang", "1 2 3 0\n2 3 4\n", ":2:1: 3 values; 4 are needed"),
        ("a.ctf", "Phase\tEuler1\tEuler2\tEuler3\n1\t2\t3\t4\n\t\t\t\n1\t2\t3\t4\n", ":3:1: an empty row; fill it in or take it out, for rows are numbered"),
        ("a.ctf", "Phase\tEuler1\tEuler2\tEuler3\tX\n1\t2\t3\t4\t\n1\t2\t3\t4\t5\n", ":2:1: 4 values; 5 are needed"),
        ("a.ctf", "Phase\tEuler1\tEuler2\tEuler3\n1\t2\t3\t4,5,6\n1\t2\t3\t4\n", ':2:1: "4,5,6" is not a number'),
    ],
)  # fmt: skip
def test_rows_of_angle_files_are_whole(name, text, message, tmp_path):
    with pytest.raises(InputError) as error:
        read("turned: {}", tmp_path, text, name)
    assert str(error.value) == f"{tmp_path / name}{message}"


@pytest.mark.parametrize(
    ("rows", "hint"),
    [
        ("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[5,5,5,1]]", "the last row of a 4x4 matrix is 0, 0, 0, 1, not 5, 5, 5, 1; is it written by columns? Then transpose it"),
        ("[1,0,0,5,0,1,0,5,0,0,1,5,0,0,0,2]", "the last row of a 4x4 matrix is 0, 0, 0, 1, not 0, 0, 0, 2"),
        ("[1,0,0,5,0,1,0,5,0,0]", "expected a rotation matrix of nine numbers, row by row"),
        ("[[1,0],[0,1]]", "a matrix has three rows of three numbers, or with a translation three or four of four"),
    ],
)  # fmt: skip
def test_homogeneous_matrices_in_lists(rows, hint, tmp_path):
    with pytest.raises(InputError) as error:
        read_orientations(
            problem(f"route: {{orientations: {{list: [{rows}, {rows}], as: matrix}}}}").route.orientations,
            tmp_path,
        )
    assert str(error.value).splitlines()[0].endswith(hint)


def mutate(rng: random.Random, lines: list[str]) -> None:
    """One of the accidents that happen to tables."""
    i = rng.randrange(len(lines))
    cells = lines[i].split(",")
    j = rng.randrange(len(cells))
    odd = ["", "nan", "1" + "0" * 400, "1e400", "-0", "1_0", '"0.5"', "0,5", "٣", "#3", "null", '"']
    match rng.randrange(10):
        case 0:
            cells[j : j + 1] = []
        case 1:
            cells.insert(j, rng.choice(["", "7", "x", "1,5"]))
        case 2:
            cells[j] = rng.choice(odd)
        case 3:
            lines.insert(i, rng.choice(["", "  ", ",", ",,,", "# c", "#1,2,3", "a,b,c"]))
            return
        case 4:
            lines[:] = [line + "," for line in lines]
            return
        case 5:
            lines[:] = [line.replace(",", rng.choice([";", "\t", " ", "  "])) for line in lines]
            return
        case 6:
            lines[i] = "#" + lines[i]
            return
        case 7:
            lines[:] = [line.replace(".", ",") for line in lines]
            return
        case 8:
            lines[i] += rng.choice([",", " ", "\t", ";", '"', "\x00"])
            return
        case _:
            lines.insert(i, lines[rng.randrange(len(lines))])
            return
    lines[i] = ",".join(cells)


def list_plainly(text: str, places: list[int], *, skip_names: bool) -> list[list[float]]:
    """The numbers of a table by the simplest reading there is."""
    lines = [line for line in text.split("\n") if line.strip()]
    while lines[0].lstrip().startswith("#"):
        lines.pop(0)
    separator = next((s for s in ";,\t" if s in lines[0].strip()), None)
    rows = [[cell.strip().strip('"') for cell in line.split(separator)] for line in lines]
    if skip_names and any(cell[:1].isalpha() for cell in rows[0]):
        rows = rows[1:]
    return [[float(row[i]) for i in places] for row in rows]


@pytest.mark.parametrize("spec", ["", ", columns: [2, 3, 4]", ", columns: [phi1, phi, phi2]"])
def test_mutated_tables_are_refused_or_read_as_they_stand(spec, tmp_path):
    """Nothing is renumbered or read from other columns, and nothing ends in a traceback."""
    rng, read_at_all = random.Random(7), 0
    for _ in range(300):
        before = ["9.5"] if spec else []
        lines = [",".join([*before, *(f"{rng.uniform(0, 99):.2f}" for _ in range(3))]) for _ in range(4)]
        if "phi" in spec or (spec and rng.random() < 0.5):
            lines.insert(0, "id,phi1,phi,phi2")
        for _ in range(rng.choice([1, 1, 2])):
            mutate(rng, lines)
        text = "\n".join(lines)
        try:
            found = read(EULER + spec, tmp_path, text)
        except InputError:
            continue
        read_at_all += 1
        rows = list_plainly(text, [1, 2, 3] if spec else [0, 1, 2], skip_names=bool(spec))
        expected = Rotation.from_euler("ZXZ", rows, degrees=True).as_quat(scalar_first=True)
        assert found.labels == tuple(str(i + 1) for i in range(len(rows))), text
        np.testing.assert_allclose(np.abs(np.sum(found.quaternions * expected, axis=1)), 1, atol=1e-12)
    assert read_at_all > 50
