"""Attitude messages (CCSDS AEM) and STK's attitudes as orientations: right by SciPy, or a remedy."""

import ccsds_ndm
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.laws import angles_between, law_of
from tests.people_files import PLACES, SOME, TURNS, XYZW, read, refuse, same
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS


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
        found = read(tmp_path, name.split("/")[-1], "".join(content), ", duplicates: merge")
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
    "no sequence": (
        stk("AttitudeTimeEulerAngles", TURNS.as_euler("ZXZ", degrees=True)),
        ": Euler angles need a Sequence, such as 321",
    ),
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
