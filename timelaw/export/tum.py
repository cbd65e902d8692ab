"""TUM trajectories: lines t tx ty tz qx qy qz qw, as SLAM tools and `evo` read them."""

from itertools import chain

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import list_instants
from timelaw.export.text_rows import format_table
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array

HEAD = "# timestamp tx ty tz qx qy qz qw\n"


def write_tum(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """Seconds, place [m] (zero where the body only turns), quaternion with the scalar last."""
    times = list_instants(law, options.rate)

    def tabulate(t: Array) -> Array:
        place = law.place(t) if law.travels else np.zeros((len(t), 3))
        return np.column_stack([t, place, np.roll(law(t), -1, axis=1)])

    return {".tum": Blocks(lambda: chain([HEAD], format_table(times, tabulate, "%.15g")))}


TUM = Exporter(
    "trajectory.tum",
    write_tum,
    "TUM trajectory: time, place, quaternion",
    "rates; all between the samples and nodes",
)
