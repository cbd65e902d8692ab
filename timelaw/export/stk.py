"""STK's attitude files (.a): quaternions, scalar last, and angular velocity in body axes in deg/s."""

from itertools import chain

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.export.text_rows import format_table
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

HEAD = """\
stk.v.11.0
BEGIN Attitude
NumberOfAttitudePoints {count}
ScenarioEpoch {epoch}
BlockingFactor 20
InterpolationOrder 1
CentralBody Earth
CoordinateAxes ICRF
AttitudeTimeQuatAngVels
"""
MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")  # in any locale


def write_stk(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """AttitudeTimeQuatAngVels: t, q1 q2 q3 q4 with the scalar last, ω in body axes."""
    times, epoch = list_instants(law, options.rate), options.epoch
    day = f"{epoch.day} {MONTHS[epoch.month - 1]} {epoch.year} {epoch:%H:%M:%S}.{epoch.microsecond:06d}"
    head, end = HEAD.format(count=len(times), epoch=day), "END Attitude\n"

    def tabulate(t: Array) -> Array:
        q, omega = law.evaluate(t, (0, 1))
        return np.column_stack([t, np.roll(q, -1, axis=1), np.degrees(omega)])

    return {".a": Blocks(lambda: chain([head], format_table(times, tabulate, "%.15e"), [end]))}


STK = Exporter(
    "attitude.a",
    write_stk,
    "STK attitude: quaternion, ω in body axes [deg/s], from an epoch in UTC",
    "α, place; all between the samples and nodes; the world is called ICRF",
    ("rate", "epoch"),
)
