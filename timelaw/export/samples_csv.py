"""`samples.csv`: the motion on an even grid of times, for anything that reads a table."""

import io
from math import ceil, floor, log10

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export.exporter import Exporter
from timelaw.motion import QuaternionLaw

COLUMNS = "t,qw,qx,qy,qz,wx,wy,wz,ax,ay,az,jx,jy,jz"
PLACE_COLUMNS = ",x,y,z,vx,vy,vz"
PLACE_HEADER = "# x y z [m], vx vy vz [m/s]: place and velocity of the body's origin in the world\n"
HEADER = """\
# timelaw samples of {name}: one row every {step} s, and the last instant
# t [s]; qw qx qy qz: unit quaternion, Hamilton, active, body to world
# wx wy wz [rad/s], ax ay az [rad/s^2], jx jy jz [rad/s^3]: angular velocity, acceleration, jerk in body axes
# at a node: the values just after it
"""
MAX_ROWS = 2_000_000
BLOCK = 20_000  # rows that are evaluated together: polynomials of high degree take some memory for each
NEAR_END = 1e-6  # of a step: a row that close to the last instant is that instant, but for rounding


def format_samples(law: QuaternionLaw, rate: float) -> str:
    """The text of the table at `rate` [1/s]: the even grid, whose last row is the last instant.

    Raises:
        InputError: the table would have more than two million rows.
    """
    refuse_too_many_rows(law.duration, rate)
    times = np.append(np.arange(count_rows(law.duration, rate) - 1) / rate, law.duration)
    text = io.StringIO()
    text.write(HEADER.format(name=law.name, step=f"{1 / rate:.9g}"))
    text.write(PLACE_HEADER if law.travels else "")
    text.write(COLUMNS + (PLACE_COLUMNS if law.travels else "") + "\n")
    for first in range(0, len(times), BLOCK):
        t = times[first : first + BLOCK]
        values = [law(t, order) for order in range(4)]
        values += [law.place(t), law.place(t, 1)] if law.travels else []
        np.savetxt(text, np.column_stack([t, *values]) + 0.0, fmt="%.15g", delimiter=",")
    return text.getvalue()


def count_rows(duration: float, rate: float) -> int:
    """How many rows a motion of `duration` [s] has: those of the grid before its end, and the end."""
    return max(ceil(duration * rate - NEAR_END), 1) + 1


def refuse_too_many_rows(duration: float, rate: float, words: str = "") -> None:
    """Say what rate is possible for a motion of `duration` [s]; `words` is "at least" if it may be longer.

    Raises:
        InputError: the table would have more than two million rows.
    """
    count = count_rows(duration, rate)
    if count > MAX_ROWS:
        rows = f"{words} {count} rows in {duration:.6g} s".strip()
        possible = MAX_ROWS / duration
        step = 10.0 ** (floor(log10(possible)) - 2)
        below = f"{floor(possible / step) * step:.6g} Hz"
        message = f"{rows}; at most {MAX_ROWS} are written, choose a lower rate, below {below}"
        raise InputError(Fault(message, "output.rate"))


CSV = Exporter("samples.csv", format_samples, usual=True)
