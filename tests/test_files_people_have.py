"""Files in the layouts that programs and robots write, read as they are: the right orientations by SciPy, or a remedy."""

import tracemalloc

import numpy as np
import pytest

from tests.cases import problem
from tests.people_files import PLACES, SOME, TURNS, XYZW, read, refuse, rows, same
from timelaw.errors import InputError
from timelaw.orientations import read_orientations

TIMES = 1305031102.1758 + np.arange(4.0)
TUM = (
    "# ground truth trajectory\n# file: 'rgbd_dataset_freiburg1_xyz.bag'\n# timestamp tx ty tz qx qy qz qw\n"
)
NANOSECONDS = ["1403636580838555648", "1403636580843555328", "1403636580848555520", "1403636580853555456"]
EUROC = (
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
    "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1]\n"
)


def test_a_tum_trajectory_has_its_header_in_a_comment(tmp_path):
    found = read(tmp_path, "groundtruth.txt", TUM + rows(TIMES, PLACES, XYZW))
    same(found)
    assert found.notes == (
        "the positions in columns tx, ty, tz of groundtruth.txt are ignored: only orientations are taken",
    )


def test_a_tum_trajectory_may_have_none_and_is_known_by_its_ending(tmp_path):
    found = read(tmp_path, "run.tum", rows(TIMES, PLACES, XYZW))
    same(found)
    assert found.notes == ("of the 8 columns of run.tum those numbered 1, 2, 3, 4 are ignored",)
    message = "the header has 1305031102.1758001, 1.3563"
    refuse(tmp_path, "run.txt", rows(TIMES, PLACES, XYZW), message)
    same(read(tmp_path, "run.txt", rows(TIMES, PLACES, XYZW), ", as: xyzw, columns: [5, 6, 7, 8]"))


def test_a_euroc_ground_truth_has_frames_and_units_in_its_names(tmp_path):
    body = rows(PLACES, SOME, PLACES, PLACES[:, 0], sep=",").splitlines()
    text = EUROC + "".join(f"{time},{row}\r\n" for time, row in zip(NANOSECONDS, body, strict=True))
    found = read(tmp_path, "data.csv", text)
    same(found)
    assert found.notes == (
        "the positions in columns p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m] of data.csv are ignored: "
        "only orientations are taken",
    )


def test_a_robots_list_is_read_by_column_numbers(tmp_path):
    """x y z A B C, as controllers of one maker print them: A about z, B about y', C about x'', in degrees."""
    abc = TURNS.as_euler("ZYX", degrees=True)
    form = ", as: euler, sequence: ZYX, unit: deg"
    found = read(tmp_path, "poses.dat", rows(1000 * PLACES, abc), form + ", columns: [4, 5, 6]")
    same(found)
    assert found.notes == ("of the 6 columns of poses.dat those numbered 1, 2, 3 are ignored",)
    refuse(tmp_path, "poses.dat", rows(1000 * PLACES, abc), "6 columns and no header; 3 are needed", form)
    headed = "# x y z A B C\n" + rows(1000 * PLACES, abc)
    same(read(tmp_path, "poses.dat", headed, form + ", columns: [A, B, C]"))


BUNGE = TURNS.as_euler("ZXZ", degrees=True)
NAMES = "Phase\tX\tY\tBands\tError\tEuler1\tEuler2\tEuler3\tMAD\tBC\tBS\n"


def ctf(angles, phases, comma=False):
    text = "Channel Text File\nPrj\tKupferprobe №1 – µm\nAuthor\tMüller\nPhases\t2\n"
    body = [
        f"{p}\t0.5\t{i}\t8\t0\t{a}\t{b}\t{c}\t0.4\t90\t80"
        for i, (p, (a, b, c)) in enumerate(zip(phases, angles, strict=True))
    ]
    lines = NAMES + "\n".join(body) + "\n"
    return (
        text.replace("№", "o").encode("latin-1", "replace")
        + (lines.replace(".", ",") if comma else lines).encode()
    )


@pytest.mark.parametrize("comma", [False, True])
def test_ctf_files_in_old_encodings_with_decimal_commas_and_nan(comma, tmp_path):
    angles = [*BUNGE.tolist(), [float("nan")] * 3, [0.0, 0.0, 0.0]]
    found = read(tmp_path, "map.ctf", ctf(angles, [1, 1, 2, 2, 1, 0], comma))
    same(found)
    assert found.labels == ("1", "2", "3", "4")
    assert found.notes == ("2 points of map.ctf were not indexed and are left out",)


def test_one_phase_of_a_ctf_file(tmp_path):
    content = ctf(BUNGE.tolist(), [1, 2, 1, 2])
    found = read(tmp_path, "map.ctf", content, ", phase: 2")
    same(found, SOME[[1, 3]])
    assert found.labels == ("2", "4")
    assert found.notes == ("2 points of map.ctf are of other phases and are left out",)
    refuse(
        tmp_path,
        "map.ctf",
        content,
        "0 indexed points of phase 3; at least two are needed; the phases are 1, 2",
        ", phase: 3",
    )


MAKERS = {
    "TSL": (
        "# TEM_PIXperUM 1.0\n# Phase 1\n# GRID: SqrGrid\n#\n",
        lambda p: f"0.00000 0.50000 50.1 0.911 {p} 1 0.7",
    ),
    "EMsoft": (
        "# TEM_PIXperUM  1.000000\n# Info  patterns indexed using EMsoft::EMEBSDDI\n",
        lambda p: f"0.000 0.500 10.2 0.600 {p}",
    ),
    "ASTAR": (
        "# File created from ACOM RES results\n# \n# phi1  Phi phi2 x y index reliability phase\n",
        lambda p: f"0.0 0.0 12.2 30.1 {p} 60.5",
    ),
}


@pytest.mark.parametrize("maker", MAKERS)
def test_ang_files_of_several_makers_and_their_phases(maker, tmp_path):
    head, rest = MAKERS[maker]
    lines = [f"{a:.9f} {b:.9f} {c:.9f} {rest(1 + i % 2)}" for i, (a, b, c) in enumerate(np.radians(BUNGE))]
    lines.insert(2, f"nan nan nan {rest(0)}")
    content = head.encode() + "\n".join(lines).encode("latin-1")
    same(read(tmp_path, "map.ang", content), atol=1e-8)
    found = read(tmp_path, "map.ang", content, ", phase: 2")
    same(found, SOME[[1, 3]], atol=1e-8)
    assert found.labels == ("2", "5")


def test_phases_belong_to_maps(tmp_path):
    refuse_message = "it belongs to the angle files of texture tools, .ang and .ctf"
    with pytest.raises(InputError, match=refuse_message):
        read(tmp_path, "scan.csv", "w,x,y,z\n1,0,0,0\n0,1,0,0\n", ", phase: 1")
    refuse(
        tmp_path,
        "short.ang",
        "0.1 0.2 0.3\n0.3 0.2 0.1\n",
        ":1:1: this file has no column of phases",
        ", phase: 1",
    )


def test_a_large_map_is_read_as_a_stream(tmp_path):
    """One point in a thousand is wanted: the text is never held whole."""
    row = "{}\t{}\t0.5\t8\t0\t10.5\t{}\t30.25\t0.4\t90\t80\n"
    with (tmp_path / "map.ctf").open("w") as file:
        file.write(NAMES)
        for block in range(25):
            file.write("".join(row.format(1 + (i == 7), i, 20 + block / 10) for i in range(1000)))
    size = (tmp_path / "map.ctf").stat().st_size
    made = problem("route: {orientations: {file: map.ctf, phase: 2}}").route.orientations
    tracemalloc.start()
    found = read_orientations(made, tmp_path)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert len(found) == 25
    assert size > 900_000
    assert peak < size / 4


@pytest.mark.parametrize("names", ["q1,q2,q3,q4", "q0,q1,q2,q3"])
def test_numbered_components_are_refused_until_their_order_is_said(names, tmp_path):
    for form, table in (("wxyz", SOME), ("xyzw", XYZW)):
        text = f"t,{names}\n" + rows(TIMES, table, sep=",")
        refuse(
            tmp_path,
            "q.csv",
            text,
            f'columns {names.replace(",", ", ")} have the scalar first for some makers and last for others; say which: "as: wxyz" or "as: xyzw"',
        )
        same(read(tmp_path, "q.csv", text, f", as: {form}"))


POSES = np.concatenate([np.concatenate([TURNS.as_matrix(), PLACES[:, :, None]], axis=2)]).reshape(-1, 12)
WHOLE = np.hstack([POSES, np.tile([0.0, 0, 0, 1], (4, 1))])
IGNORED = "the translations of the matrices in {} are ignored: only their rotations are taken"


@pytest.mark.parametrize("table", [POSES, WHOLE], ids=["3x4", "4x4"])
def test_poses_give_their_rotations_and_say_so(table, tmp_path):
    found = read(
        tmp_path, "poses.txt", rows(table), ", as: matrix"
    )  # a line each, as odometry files have them
    same(found)
    assert found.notes == (IGNORED.format("poses.txt"),)
    assert found.precision.angle < 1e-12
    nested = [row.reshape(-1, 4).tolist() for row in table]
    for written in (table.tolist(), nested):
        listed = problem(f"route: {{orientations: {{list: {written}, as: matrix}}}}").route.orientations
        found = read_orientations(listed, tmp_path)
        same(found)
        assert found.notes == (IGNORED.format("the list"),)
