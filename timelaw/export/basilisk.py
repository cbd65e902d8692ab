"""Waypoints for Basilisk's module `waypointReference`: no header line, attitudes as Euler parameters.

Its reader takes ω and α in inertial axes unless `useReferenceFrame` is set; so they are written.
"""

import io

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.export.world_rates import turn_to_world
from timelaw.motion import QuaternionLaw


def write_waypoints(law: QuaternionLaw, options: Options) -> dict[str, str]:
    """Rows t, q (scalar first: attitudeType 1), ω, α in inertial axes, with commas."""
    t = list_instants(law, options.rate)
    rows = np.column_stack([t, law(t), turn_to_world(law, t, 1), turn_to_world(law, t, 2)])
    text = io.StringIO()
    np.savetxt(text, rows + 0.0, fmt="%.15g", delimiter=",")
    return {".txt": text.getvalue()}


BASILISK = Exporter(
    "waypoints.txt",
    write_waypoints,
    "Basilisk waypoints: t, quaternion (attitudeType 1), ω and α in inertial axes (useReferenceFrame False)",
    "jerk, place; all between the samples and nodes",
)
