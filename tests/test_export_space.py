"""Attitude files of space flight, read by others: CCSDS AEM by ccsds-ndm-py, STK and Basilisk by their layout."""

from dataclasses import replace
from datetime import datetime
from itertools import pairwise

import ccsds_ndm
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.laws import LAWS, angles_between, law_of, quarter_turn
from timelaw.export.aem import format_instant
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS

EPOCH = datetime(2031, 12, 31, 23, 59, 58, 250000)
OPTIONS = Options(20.0, EPOCH)


def seconds_after(text):
    """Of the epoch, in parts that a double holds."""
    whole, part = text.split(".")
    return (datetime.fromisoformat(whole) - EPOCH.replace(microsecond=0)).total_seconds() + (
        float(f"0.{part}") - 0.25
    )


def read_aem(text):
    """Segments of (metadata, times [s] (m,), values (m, n)) by ccsds-ndm-py."""
    message = ccsds_ndm.from_str(text)
    for segment in message.segments:
        epochs = [seconds_after(str(state.epoch)) for state in segment.data.attitude_states]
        yield segment.metadata, np.array(epochs), np.array([s.values for s in segment.data.attitude_states])


@pytest.mark.parametrize("name", LAWS)
def test_an_aem_reader_gets_orientations_and_rates_of_each_segment(name):
    law = law_of(name)
    segments = list(read_aem("".join(EXPORTERS["aem"].write(law, OPTIONS)[".aem"])))
    assert len(segments) == len(law.segments)
    for (metadata, t, values), segment in zip(segments, law.segments, strict=True):
        assert str(metadata.attitude_type) == "QUATERNION/ANGVEL"
        assert (metadata.ref_frame_a, metadata.ref_frame_b) == ("EME2000", "SC_BODY_1")
        assert metadata.angvel_frame == "SC_BODY_1"
        tau = ((t - segment.start_time) / segment.duration).clip(0, 1)
        assert tau[0] == pytest.approx(0, abs=1e-11)
        assert tau[-1] == pytest.approx(1, abs=1e-11)
        assert np.max(np.diff(t)) < 1 / 20 + 1e-9
        assert np.max(angles_between(np.roll(values[:, :4], 1, axis=1), segment(tau, 0, "right"))) < 1e-11
        np.testing.assert_allclose(values[:, 4:], np.degrees(segment(tau, 1, "right")), atol=1e-8)
    for (_, before, _), (_, after, _) in pairwise(segments):
        assert before[-1] == after[0]  # segments meet, none overlaps


@pytest.mark.parametrize("name", ["paper", "mixed"])
def test_version_1_is_version_2_without_rates(name):
    """The reader knows no keys of version 1; what they say is compared as text."""
    law = law_of(name)
    text = "".join(EXPORTERS["aem-1.0"].write(law, OPTIONS)[".aem"])
    assert text.startswith("CCSDS_AEM_VERS = 1.0\n")
    count = len(law.segments)
    for line in ("ATTITUDE_DIR = A2B\n", "QUATERNION_TYPE = LAST\n", "TIME_SYSTEM = UTC\n"):
        assert text.count(line) == count
    plain = text.replace("ATTITUDE_DIR = A2B\n", "").replace("QUATERNION_TYPE = LAST\n", "")
    second = read_aem("".join(EXPORTERS["aem"].write(law, OPTIONS)[".aem"]))
    for (metadata, t, values), (_, times, more) in zip(read_aem(plain), second, strict=True):
        assert str(metadata.attitude_type) == "QUATERNION"
        np.testing.assert_array_equal(t, times)
        np.testing.assert_array_equal(values, more[:, :4])


def test_a_quarter_turn_about_z_has_the_sense_of_the_standard():
    """Annex of the standard: Q = e sin(φ/2), QC = cos(φ/2) turns frame A into B; body axes are B."""
    law = quarter_turn()
    ((_, _, values),) = read_aem("".join(EXPORTERS["aem"].write(law, OPTIONS)[".aem"]))
    np.testing.assert_allclose(values[-1, :4], [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-14)
    middle = len(values) // 2
    np.testing.assert_allclose(values[middle, 4:], [0, 0, 90 / 2 * 15 / 8], atol=1e-9)
    rows = read_stk("".join(EXPORTERS["stk"].write(law, OPTIONS)[".a"]))
    np.testing.assert_allclose(rows[-1, 1:5], [0, 0, np.sqrt(0.5), np.sqrt(0.5)], atol=1e-14)
    assert np.all(rows[1:-1, 7] > 0)


def test_names_break_no_line():
    law = replace(quarter_turn(), name="Überflug\nMETA_STOP")
    text = "".join(EXPORTERS["aem"].write(law, OPTIONS)[".aem"])
    assert "OBJECT_NAME = ?berflug META_STOP\n" in text
    assert len(list(read_aem(text))) == 1


def test_instants_carry_over_into_the_next_year():
    assert format_instant(EPOCH, 0.0) == "2031-12-31T23:59:58.250000000000"
    assert format_instant(EPOCH, 1.75) == "2032-01-01T00:00:00.000000000000"
    assert format_instant(EPOCH, 1.75 - 1e-12) == "2031-12-31T23:59:59.999999999999"


def read_stk(text):
    """Rows t, q1 q2 q3 q4, ω of a file whose layout is as STK's examples have it."""
    lines = text.splitlines()
    assert lines[0].startswith("stk.v.")
    assert lines[1] == "BEGIN Attitude"
    start = lines.index("AttitudeTimeQuatAngVels")
    keys = dict(line.split(maxsplit=1) for line in lines[2:start])
    rows = np.array([[float(x) for x in line.split()] for line in lines[start + 1 : -1]])
    assert lines[-1] == "END Attitude"
    assert int(keys["NumberOfAttitudePoints"]) == len(rows)
    assert keys["ScenarioEpoch"] == "31 Dec 2031 23:59:58.250000"
    return rows


@pytest.mark.parametrize("name", LAWS)
def test_stk_has_the_scalar_last_and_rates_in_degrees(name):
    law = law_of(name)
    rows = read_stk("".join(EXPORTERS["stk"].write(law, OPTIONS)[".a"]))
    t = rows[:, 0].clip(0, law.duration)
    assert np.all(np.diff(t) > 0)
    assert set(np.round(law.times, 12)) <= set(np.round(t, 12))
    turns = Rotation.from_quat(rows[:, 1:5])  # SciPy has the scalar last too
    np.testing.assert_allclose(turns.as_matrix(), law.rotation(t), atol=1e-13)
    np.testing.assert_allclose(rows[:, 5:], np.degrees(law(t, 1)), atol=1e-8)


@pytest.mark.parametrize("name", LAWS)
def test_basilisk_gets_rates_that_turn_the_attitude_in_the_inertial_frame(name):
    """dR/dt = [ω]× R with ω in inertial axes, and α is its derivative: by differences of the file's own rows."""
    law = law_of(name)
    text = "".join(EXPORTERS["basilisk"].write(law, Options(400.0))[".txt"])
    rows = np.array([[float(x) for x in line.split(",")] for line in text.splitlines()])  # from line 1
    assert rows.shape[1] == 11
    t, turns = rows[:, 0], Rotation.from_quat(rows[:, 1:5], scalar_first=True)
    steps, middle = np.diff(t), (rows[:-1, 5:] + rows[1:, 5:]) / 2
    long = steps > 1e-3
    moved = (turns[1:] * turns[:-1].inv()).as_rotvec()[long] / steps[long, None]
    np.testing.assert_allclose(moved, middle[long, :3], atol=2e-5)
    breaks = np.concatenate(
        [s.start_time + s.duration * s.breaks for s in law.segments]
    )  # there jerk may jump
    inside = long & (np.min(np.abs(t[:-1, None] + steps[:, None] / 2 - breaks), axis=1) > 3e-3)
    change = (np.diff(rows[:, 5:8], axis=0) / steps[:, None])[inside]
    np.testing.assert_allclose(change, middle[inside, 3:], atol=3e-4)
