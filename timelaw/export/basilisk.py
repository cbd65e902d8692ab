"""Waypoints for Basilisk's module `waypointReference`: no header line, attitudes as Euler parameters.

Its reader takes ω and α in inertial axes unless `useReferenceFrame` is set; so they are written.
"""

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.export.text_rows import format_table
from timelaw.export.world_rates import turn_to_world
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array


def write_waypoints(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """Rows t, q (scalar first: attitudeType 1), ω, α in inertial axes, with commas."""
    times = list_instants(law, options.rate)

    def tabulate(t: Array) -> Array:
        return np.column_stack([t, law(t), turn_to_world(law, t, 1), turn_to_world(law, t, 2)])

    return {".txt": Blocks(lambda: format_table(times, tabulate, "%.15g", ","))}


BASILISK = Exporter(
    "waypoints.txt",
    write_waypoints,
    "Basilisk waypoints: t, quaternion (attitudeType 1), ω and α in inertial axes (useReferenceFrame False)",
    "jerk, place; all between the samples and nodes",
)
