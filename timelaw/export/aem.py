"""CCSDS Attitude Ephemeris Messages in keyword-value notation: version 2.0, and 1.0 as GMAT reads it.

REF_FRAME_A is the world and REF_FRAME_B the body; with that sense QC Q1 Q2 Q3 are w x y z here. Each segment
of the motion is one of the message, for readers must not interpolate across them.
"""

from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime, timedelta
from functools import lru_cache

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import refuse_too_many_rows, sample_segments
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw, Segment
from timelaw.numerics.array import Array

WORLD, BODY = "EME2000", "SC_BODY_1"
PICOSECONDS = 10**12  # in a second; finer than doubles are after an hour
Rows = Callable[[Segment, Array], Array]


def format_instant(epoch: datetime, seconds: float) -> str:
    """A time so long after an epoch, to the picosecond, as in 2000-01-01T12:00:01.500000000000."""
    whole, part = divmod(round(seconds * PICOSECONDS) + epoch.microsecond * 10**6, PICOSECONDS)
    return f"{_format_second(epoch, whole)}.{part:012d}"


@lru_cache(maxsize=1)  # there are many instants in a second
def _format_second(epoch: datetime, seconds: int) -> str:
    return f"{epoch + timedelta(seconds=seconds):%Y-%m-%dT%H:%M:%S}"


def write_aem_2(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """Version 2.0: quaternions, scalar last, and rates in body axes in deg/s."""
    kind = ["ATTITUDE_TYPE = QUATERNION/ANGVEL", f"ANGVEL_FRAME = {BODY}"]
    return {".aem": _write(law, options, "2.0", "TAI", kind, _with_rates)}


def write_aem_1(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """Version 1.0: quaternions, scalar last."""
    kind = ["ATTITUDE_DIR = A2B", "ATTITUDE_TYPE = QUATERNION", "QUATERNION_TYPE = LAST"]
    return {".aem": _write(law, options, "1.0", "UTC", kind, _scalar_last)}


def _scalar_last(segment: Segment, tau: Array) -> Array:
    return np.roll(segment(tau, 0, "right"), -1, axis=1)


def _with_rates(segment: Segment, tau: Array) -> Array:
    return np.hstack([_scalar_last(segment, tau), np.degrees(segment(tau, 1, "right"))])


def _write(
    law: QuaternionLaw, options: Options, version: str, clock: str, kind: list[str], rows: Rows
) -> Blocks:
    refuse_too_many_rows(law.duration, options.rate)
    head = [
        f"CCSDS_AEM_VERS = {version}",
        f"CREATION_DATE = {datetime.now(UTC):%Y-%m-%dT%H:%M:%S}",
        "ORIGINATOR = TIMELAW",
    ]

    def list_segments() -> Iterator[str]:
        yield _join(head)
        for segment, tau, times in sample_segments(law, options.rate):
            with np.errstate(all="ignore"):  # what a hostile law overflows is not finite in the file
                values = rows(segment, tau)
            data = ["DATA_START", *_list_rows(options.epoch, times, values), "DATA_STOP"]
            yield _join([*_describe(law, segment, options.epoch, clock, kind), *data])

    return Blocks(list_segments)


def _join(lines: Sequence[str]) -> str:
    return "\n".join(lines) + "\n"


def _describe(
    law: QuaternionLaw, segment: Segment, epoch: datetime, clock: str, kind: list[str]
) -> list[str]:
    """The metadata of one segment."""
    first, last = (format_instant(epoch, t) for t in (segment.start_time, segment.end_time))
    called = _on_one_line(law.name)
    order = {  # as the standard has it
        "OBJECT_NAME": called,
        "OBJECT_ID": called,
        "CENTER_NAME": "EARTH",
        "REF_FRAME_A": WORLD,
        "REF_FRAME_B": BODY,
    }
    keys = [f"{key} = {value}" for key, value in order.items()]
    time = [f"TIME_SYSTEM = {clock}", f"START_TIME = {first}", f"STOP_TIME = {last}"]
    sense = [line for line in kind if line.startswith("ATTITUDE_DIR")]
    rest = [line for line in kind if line not in sense]
    reading = ["INTERPOLATION_METHOD = LINEAR", "INTERPOLATION_DEGREE = 1"]
    return [
        "META_START",
        f"COMMENT {_on_one_line(segment.name)}",
        *keys,
        *sense,
        *time,
        *rest,
        *reading,
        "META_STOP",
    ]


def _on_one_line(name: str) -> str:
    """A name as a value: in ASCII, which the standard has, without breaks."""
    return " ".join(name.replace("–", "-").encode("ascii", "replace").decode().split()) or "BODY"


def _list_rows(epoch: datetime, times: Array, rows: Array) -> Iterator[str]:
    cells = " ".join(["%s"] + ["%.15f"] * rows.shape[1])
    for t, row in zip(times.tolist(), (rows + 0.0).tolist(), strict=True):
        yield cells % (format_instant(epoch, t), *row)


LOSES = "α, place; all between the samples; the world is called EME2000"
AEM_2 = Exporter(
    "attitude.aem",
    write_aem_2,
    "CCSDS AEM 2.0 (KVN): quaternion, ω in body axes [deg/s], a segment each arc, TAI",
    LOSES,
    ("rate", "epoch"),
)
AEM_1 = Exporter(
    "attitude-1.0.aem",
    write_aem_1,
    "CCSDS AEM 1.0 (KVN), for GMAT: quaternion, a segment each arc, UTC",
    "ω, " + LOSES,
    ("rate", "epoch"),
)
