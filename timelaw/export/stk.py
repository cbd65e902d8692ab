"""STK's attitude files (.a): quaternions, scalar last, and angular velocity in body axes in deg/s."""

import io

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.motion import QuaternionLaw

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


def write_stk(law: QuaternionLaw, options: Options) -> dict[str, str]:
    """AttitudeTimeQuatAngVels: t, q1 q2 q3 q4 with the scalar last, ω in body axes."""
    t, epoch = list_instants(law, options.rate), options.epoch
    day = f"{epoch.day} {MONTHS[epoch.month - 1]} {epoch.year} {epoch:%H:%M:%S}.{epoch.microsecond:06d}"
    text = io.StringIO()
    text.write(HEAD.format(count=len(t), epoch=day))
    rows = np.column_stack([t, np.roll(law(t), -1, axis=1), np.degrees(law(t, 1))])
    np.savetxt(text, rows + 0.0, fmt="%.15e")
    text.write("END Attitude\n")
    return {".a": text.getvalue()}


STK = Exporter(
    "attitude.a",
    write_stk,
    "STK attitude: quaternion, ω in body axes [deg/s], from an epoch in UTC",
    "α, place; all between the samples and nodes; the world is called ICRF",
    ("rate", "epoch"),
)
