"""Files in the layouts that programs and robots write, read as they are: the right orientations by SciPy, or a remedy."""

import tracemalloc

import ccsds_ndm
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import problem, unit_quaternions
from tests.laws import angles_between, law_of
from timelaw.errors import InputError
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS
from timelaw.orientations import read_orientations

SOME = unit_quaternions(np.random.default_rng(11), 4)
TURNS = Rotation.from_quat(SOME, scalar_first=True)
PLACES = np.array([[1.3563, 0.6305, 1.638], [1.3543, 0.6306, 1.6360], [1.35, 0.63, 1.63], [1.34, 0.62, 1.62]])
XYZW = SOME[:, [1, 2, 3, 0]]


def read(folder, name, content, more=""):
    data = content if isinstance(content, bytes) else content.encode()
    (folder / name).write_bytes(data)
    made = problem(f"route: {{orientations: {{file: {name}{more}}}}}")
    return read_orientations(made.route.orientations, folder)


def refuse(folder, name, content, message, more=""):
    with pytest.raises(InputError) as error:
        read(folder, name, content, more)
    assert message in str(error.value)
    assert name in str(error.value)


def same(found, expected=SOME, atol=1e-12):
    assert len(found) == len(expected)
    assert np.max(angles_between(found.quaternions, expected)) < atol


def rows(*columns, sep=" ", digits=".17g"):
    table = np.column_stack(columns)
    return "\n".join(sep.join(format(v, digits) for v in row) for row in table.tolist()) + "\n"


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


def aem(version, meta, data):
    body = "\n".join(f"2024-05-01T00:00:{i:02d}.000 {line}" for i, line in enumerate(data))
    return (
        f"CCSDS_AEM_VERS = {version}\nCREATION_DATE = 2024-05-01T00:00:00\nORIGINATOR = TEST\n\nMETA_START\n"
        "COMMENT a segment\nOBJECT_NAME = SAT\nOBJECT_ID = 2024-001A\nCENTER_NAME = EARTH\n"
        f"{meta}\nMETA_STOP\nDATA_START\n{body}\nDATA_STOP\n"
    )


def frames(first="EME2000", second="SC_BODY_1", sense=""):
    return (
        f"REF_FRAME_A = {first}\nREF_FRAME_B = {second}\n{sense}TIME_SYSTEM = UTC\n"
        "START_TIME = 2024-05-01T00:00:00.000\nSTOP_TIME = 2024-05-01T00:00:03.000\n"
    )


def cells(table, more=()):
    return [" ".join(f"{v:.15f}" for v in [*row, *more]) for row in table.tolist()]


A2B, B2A = "ATTITUDE_DIR = A2B\n", "ATTITUDE_DIR = B2A\n"
BACK = SOME * [1, -1, -1, -1]
MESSAGES = {
    "2.0": ("2.0", frames() + "ATTITUDE_TYPE = QUATERNION", cells(XYZW)),
    "2.0 with rates": ("2.0", frames() + "ATTITUDE_TYPE = QUATERNION/ANGVEL\nANGVEL_FRAME = SC_BODY_1", cells(XYZW, (1, 2, 3))),
    "2.0 from the body": ("2.0", frames("SC_BODY_1", "ICRF") + "ATTITUDE_TYPE = QUATERNION", cells(BACK[:, [1, 2, 3, 0]])),
    "2.0 Euler": ("2.0", frames() + "ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = ZYX", cells(TURNS.as_euler("ZYX", degrees=True))),
    "1.0 scalar first": ("1.0", frames(sense=A2B) + "ATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = FIRST", cells(SOME)),
    "1.0 scalar last": ("1.0", frames(sense=A2B) + "ATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = LAST", cells(XYZW)),
    "1.0 back": ("1.0", frames(sense=B2A) + "ATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = FIRST", cells(BACK)),
    "1.0 back from the body": ("1.0", frames("SC_BODY_1", "EME2000", B2A) + "ATTITUDE_TYPE = QUATERNION/RATE\nQUATERNION_TYPE = FIRST", cells(SOME, (0, 0, 0))),
    "1.0 Euler 321": ("1.0", frames(sense=A2B) + "ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = 321", cells(TURNS.as_euler("ZYX", degrees=True))),
}  # fmt: skip


@pytest.mark.parametrize("case", MESSAGES)
def test_attitude_messages(case, tmp_path):
    version, meta, data = MESSAGES[case]
    same(read(tmp_path, "attitude.aem", aem(version, meta, data)))


def test_joints_of_segments_that_repeat_an_attitude_are_one(tmp_path):
    meta = frames() + "ATTITUDE_TYPE = QUATERNION"
    first, second = aem("2.0", meta, cells(XYZW[:3])), aem("2.0", meta, cells(XYZW[2:]))
    same(read(tmp_path, "attitude.aem", first + second[second.index("META_START") :]))


def test_an_exported_law_comes_back(tmp_path):
    law = law_of("dwells")
    for key in ("aem", "aem-1.0", "stk", "tum"):
        files = EXPORTERS[key].name_files(law, Options(4.0), tmp_path / EXPORTERS[key].file_name)
        ((name, content),) = files.items()
        found = read(tmp_path, name.split("/")[-1], content, ", duplicates: merge")
        nodes = [law.segments[0].start, *(s.end for s in law.segments)]
        for node in nodes:
            assert np.min(angles_between(found.quaternions, node)) < 1e-9
        assert len(found) > 10


def test_what_another_program_wrote_is_read(tmp_path):
    """A message that ccsds-ndm-py has written from its own objects."""
    message = ccsds_ndm.from_str(aem("2.0", frames() + "ATTITUDE_TYPE = QUATERNION", cells(XYZW)))
    same(read(tmp_path, "attitude.aem", message.to_str(format="kvn")))


WRONG = {
    "no body": (aem("2.0", frames("EME2000", "ITRF") + "ATTITUDE_TYPE = QUATERNION", cells(XYZW)), ":10:1: frames EME2000 and ITRF: one of them must be the body's"),
    "xml": ('<?xml version="1.0"?>\n<aem/>\n', ":1:1: this is XML; the keyword-value notation (KVN) is read"),
    "an orbit": ("CCSDS_OEM_VERS = 2.0\n", ":1:1: not an attitude ephemeris message: CCSDS_AEM_VERS comes first"),
    "version 3": ("CCSDS_AEM_VERS = 3.0\n", ':1:1: version "3.0"; 1.0 and 2.0 are read'),
    "spin": (aem("2.0", frames() + "ATTITUDE_TYPE = SPIN", cells(XYZW)), ":15:1: ATTITUDE_TYPE SPIN; quaternions and Euler angles are read"),
    "no type": (aem("2.0", frames(), cells(XYZW)), "ATTITUDE_TYPE is missing; quaternions and Euler angles are read"),
    "no order": (aem("1.0", frames(sense=A2B) + "ATTITUDE_TYPE = QUATERNION", cells(XYZW)), "QUATERNION_TYPE is missing, which version 1.0 must have; LAST or FIRST is needed"),
    "no sense": (aem("1.0", frames() + "ATTITUDE_TYPE = QUATERNION\nQUATERNION_TYPE = LAST", cells(XYZW)), "ATTITUDE_DIR is missing, which version 1.0 must have; A2B or B2A is needed"),
    "no sequence": (aem("2.0", frames() + "ATTITUDE_TYPE = EULER_ANGLE", cells(XYZW)), ":5:1: Euler angles need EULER_ROT_SEQ"),
    "an odd sequence": (aem("2.0", frames() + "ATTITUDE_TYPE = EULER_ANGLE\nEULER_ROT_SEQ = 331", cells(XYZW)), ':16:1: "331" is no sequence of three turns such as 321'),
    "a short row": (aem("2.0", frames() + "ATTITUDE_TYPE = QUATERNION", ["0 0 0 1", "0 0 1"]), ":19:1: 4 values; an epoch and 4 numbers are needed"),
    "a zero": (aem("2.0", frames() + "ATTITUDE_TYPE = QUATERNION", ["0 0 0 1", "0 0 0 0"]), ":19:1: a quaternion of norm 0 has no direction"),
    "one": (aem("2.0", frames() + "ATTITUDE_TYPE = QUATERNION", ["0 0 0 1"]), ": fewer than two attitudes; at least two are needed"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_messages_that_are_wrong(case, tmp_path):
    content, message = WRONG[case]
    refuse(tmp_path, "a.aem", content, f"a.aem{message}" if message.startswith(":") else message)


def stk(kind, table, keys="", end="END Attitude\n"):
    body = "\n".join(f" {5.0 * i:.4f}  {line}" for i, line in enumerate(cells(table)))
    count = f"NumberOfAttitudePoints {len(table)}\n"
    head = f"stk.v.11.0\n# made by hand\nBEGIN Attitude\n{count}ScenarioEpoch 1 Jun 2002 12:00:00.000\nCoordinateAxes J2000\n"
    return f"{head}{keys}{kind}\n{body}\n{end}"


COSINES = np.swapaxes(TURNS.as_matrix(), 1, 2).reshape(-1, 9)  # STK's turn the reference axes into the body's
ATTITUDES = {
    "scalar last": stk("AttitudeTimeQuaternions", XYZW),
    "no end": stk("AttitudeTimeQuaternions", XYZW, end=""),
    "with rates": stk("AttitudeTimeQuatAngVels", np.hstack([XYZW, PLACES])),
    "scalar first": stk("AttitudeTimeQuatScalarFirst", SOME),
    "angles": stk("AttitudeTimeEulerAngles", TURNS.as_euler("ZXZ", degrees=True), "Sequence 313\n"),
    "cosines": stk("AttitudeTimeDCM", COSINES),
    "cosines with rates": stk("AttitudeTimeDCMAngVels", np.hstack([COSINES, PLACES])),
    "norms": stk("AttitudeTimeQuaternions", XYZW * [[1.0], [1.01], [0.98], [1.0]]),
}


@pytest.mark.parametrize("case", ATTITUDES)
def test_stk_attitudes(case, tmp_path):
    found = read(tmp_path, "sat.a", ATTITUDES[case])
    same(found)
    assert found.notes == (
        ("norms of the quaternions in sat.a are off by up to 0.02: each is divided by its own",)
        * (case == "norms")
    )


def test_stks_own_example_turns_as_its_rates_say(tmp_path):
    """From the maker's manual: 6 deg/s about z for 10 s is 60°, q3 = +0.5, q4 = 0.866."""
    text = stk(
        "AttitudeTimeQuatAngVels", np.array([[0, 0, 0, 1, 0, 0, 6], [0, 0, 0.5, np.sqrt(0.75), 0, 0, 6.0]])
    )
    found = read(tmp_path, "sat.a", text)
    same(found, Rotation.from_rotvec([[0, 0, 0], [0, 0, np.pi / 3]]).as_quat(scalar_first=True))


BAD = {
    "another file": ("BEGIN Attitude\n", ":1:1: not a file of STK"),
    "vectors": (
        stk("AttitudeTimeECIVector", PLACES),
        ':7:1: "AttitudeTimeECIVector"; attitudetimequaternions, ',
    ),
    "nothing": (
        "stk.v.4.0\nBEGIN Attitude\nEND Attitude\n",
        ": no block of attitudes; attitudetimequaternions",
    ),
    "no sequence": (stk("AttitudeTimeEulerAngles", BUNGE), ": Euler angles need a Sequence, such as 321"),
    "a short row": (
        stk("AttitudeTimeQuaternions", PLACES),
        ":8:1: 4 values; a time and 4 numbers are needed",
    ),
    "no matrix": (
        stk("AttitudeTimeDCM", np.ones((2, 9))),
        ":8:1: not a rotation matrix: RᵀR differs from 1 by 3",
    ),
    "one": (stk("AttitudeTimeQuaternions", XYZW[:1]), ": 1 attitudes; at least two are needed"),
}


@pytest.mark.parametrize("case", BAD)
def test_stk_files_that_are_wrong(case, tmp_path):
    content, message = BAD[case]
    refuse(tmp_path, "sat.a", content, f"sat.a{message}")


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
