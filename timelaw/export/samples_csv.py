"""`samples.csv`: the motion on an even grid of times, for anything that reads a table.

Its header is line 1, so that `pandas.read_csv` and MATLAB's `readtable` need no option.
"""

import csv
import io

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import NEAR_END, label_nodes, list_grid, number_segments, tabulate
from timelaw.motion import QuaternionLaw

BLOCK = 20_000  # rows that are evaluated together: polynomials of high degree take some memory for each


def format_samples(law: QuaternionLaw, rate: float) -> str:
    """The text of the table at `rate` [1/s]: the even grid, whose last row is the last instant.

    Raises:
        InputError: the table would have more than two million rows.
    """
    times = list_grid(law, rate)
    text = io.StringIO()
    for first in range(0, len(times), BLOCK):
        t = times[first : first + BLOCK]
        columns = tabulate(law, t)
        if not first:
            text.write(",".join([*columns, "segment", "node"]) + "\n")
        numbers = np.column_stack(list(columns.values())) + 0.0
        segments = number_segments(law, t).tolist()
        nodes = label_nodes(law, t, NEAR_END / rate)
        row_format = ",".join(["%.15g"] * len(columns)) + ",%d,%s\n"
        for row, segment, node in zip(numbers.tolist(), segments, nodes, strict=True):
            text.write(row_format % (*row, segment, _quote(node)))
    return text.getvalue()


def write_samples(law: QuaternionLaw, options: Options) -> dict[str, str]:
    """The table as an exporter gives it."""
    return {".csv": format_samples(law, options.rate)}


def _quote(label: str) -> str:
    """A label as CSV needs it."""
    if not any(c in label for c in ',"\n\r'):
        return label
    line = io.StringIO()
    csv.writer(line, lineterminator="").writerow([label])
    return line.getvalue()


CSV = Exporter(
    "samples.csv",
    write_samples,
    "time, quaternion, ω, α, jerk; place, velocity, torque, momentum where known; segment and node",
    "all between the samples",
    usual=True,
)
