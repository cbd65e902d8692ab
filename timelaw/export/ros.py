"""ROS 2 `trajectory_msgs/MultiDOFJointTrajectory` as YAML, which `ros2 topic pub` takes.

Twists and accelerations are in world axes, those of `header.frame_id`, as the messages' users have them.
"""

from collections.abc import Iterable
from itertools import chain

import numpy as np
from numpy.typing import NDArray

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.export.text_rows import cut_rows
from timelaw.export.world_rates import turn_to_world
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

NANOSECONDS = 10**9
HEAD = """\
header:
  stamp: {sec: 0, nanosec: 0}
  frame_id: world
joint_names: [body]
points:
"""
POINT = """\
- transforms:
  - translation: %s
    rotation: %s
  velocities:
  - linear: %s
    angular: %s
  accelerations:
  - linear: %s
    angular: %s
  time_from_start: {sec: %d, nanosec: %d}
"""


def write_ros(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """One joint, `body`: transforms, velocities, accelerations, and the time from the start."""
    t = list_instants(law, options.rate)
    ticks = np.unique(np.round(t * NANOSECONDS).astype(np.int64))  # what the message can say
    return {
        ".yaml": Blocks(
            lambda: chain([HEAD], (_list_points(law, ticks[own]) for own in cut_rows(len(ticks))))
        )
    }


def _list_points(law: QuaternionLaw, ticks: NDArray[np.int64]) -> str:
    """The points at some instants [ns]."""
    t = np.minimum(ticks / NANOSECONDS, law.duration)
    with np.errstate(all="ignore"):  # what a hostile law overflows is not finite in the file
        places = [law.place(t, k) for k in range(3)] if law.travels else [np.zeros((len(t), 3))] * 3
        turns = [law(t), turn_to_world(law, t, 1), turn_to_world(law, t, 2)]
    columns = [
        _write_each(places[0]),
        _write_each(np.roll(turns[0], -1, axis=1)),
        *(_write_each(values) for pair in zip(places[1:], turns[1:], strict=True) for values in pair),
    ]
    points = zip(ticks.tolist(), *columns, strict=True)
    return "".join([POINT % (*entries, *divmod(tick, NANOSECONDS)) for tick, *entries in points])


def _write_each(values: Array) -> Iterable[str]:
    """{x: …, y: …, z: …[, w: …]} of each row."""
    for row in (values + 0.0).tolist():
        pairs = zip("xyzw"[: len(row)], row, strict=True)
        yield "{" + ", ".join(f"{axis}: {write_number(value)}" for axis, value in pairs) + "}"


def write_number(value: float) -> str:
    """A number that YAML 1.1 reads as one: 1e-05 is a text there, 1.0e-05 is not."""
    text = repr(float(value))
    mantissa, sign, exponent = text.partition("e")
    return text if not sign or "." in mantissa else f"{mantissa}.0e{exponent}"


ROS = Exporter(
    "trajectory.yaml",
    write_ros,
    "ROS 2 MultiDOFJointTrajectory: place, quaternion, velocities and accelerations in world axes",
    "jerk; all between the samples and nodes; times to the nanosecond",
)
