"""`samples.csv`: the motion on an even grid of times, for anything that reads a table."""

import io
from math import floor

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export.exporter import Exporter
from timelaw.motion import QuaternionLaw

COLUMNS = "t,qw,qx,qy,qz,wx,wy,wz,ax,ay,az,jx,jy,jz"
HEADER = """\
# timelaw samples of {name}: one row every {step} s, and the last instant
# t [s]; qw qx qy qz: unit quaternion, Hamilton, active, body to world
# wx wy wz [rad/s], ax ay az [rad/s^2], jx jy jz [rad/s^3]: angular velocity, acceleration, jerk in body axes
# at a node: the values just after it
"""
MAX_ROWS = 2_000_000


def format_samples(law: QuaternionLaw, rate: float) -> str:
    """The text of the table at `rate` [1/s].

    Raises:
        InputError: the table would have more than two million rows.
    """
    count = floor(law.duration * rate) + 1
    if count > MAX_ROWS:
        message = f"{count} rows in {law.duration:.6g} s; at most {MAX_ROWS} are written, choose a lower rate"
        raise InputError(Fault(message, "output.rate"))
    times = np.arange(count) / rate
    if times[-1] < law.duration:
        times = np.append(times, law.duration)
    times[-1] = min(times[-1], law.duration)
    table = np.column_stack([times, *(law(times, order) for order in range(4))]) + 0.0
    text = io.StringIO()
    text.write(HEADER.format(name=law.name, step=f"{1 / rate:.9g}"))
    np.savetxt(text, table, fmt="%.15g", delimiter=",", header=COLUMNS, comments="")
    return text.getvalue()


CSV = Exporter("samples.csv", format_samples, usual=True)
