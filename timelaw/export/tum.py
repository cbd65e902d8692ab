"""TUM trajectories: lines t tx ty tz qx qy qz qw, as SLAM tools and `evo` read them."""

import io

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.motion import QuaternionLaw


def write_tum(law: QuaternionLaw, options: Options) -> dict[str, str]:
    """Seconds, place [m] (zero where the body only turns), quaternion with the scalar last."""
    t = list_instants(law, options.rate)
    place = law.place(t) if law.travels else np.zeros((len(t), 3))
    text = io.StringIO()
    text.write("# timestamp tx ty tz qx qy qz qw\n")
    np.savetxt(text, np.column_stack([t, place, np.roll(law(t), -1, axis=1)]) + 0.0, fmt="%.15g")
    return {".tum": text.getvalue()}


TUM = Exporter(
    "trajectory.tum",
    write_tum,
    "TUM trajectory: time, place, quaternion",
    "rates; all between the samples and nodes",
)
