"""`samples.csv`: the motion on an even grid of times, for anything that reads a table.

Its header is line 1, so that `pandas.read_csv` and MATLAB's `readtable` need no option.
"""

import csv
import io
from collections.abc import Iterator

import numpy as np

from timelaw.export.exporter import Exporter, Options
from timelaw.export.samples import (
    MAX_ROWS,
    NEAR_END,
    cut_grid,
    label_nodes,
    number_segments,
    refuse_too_many_rows,
    tabulate,
)
from timelaw.export.text_rows import format_rows
from timelaw.files import Blocks
from timelaw.motion import QuaternionLaw
from timelaw.numerics.array import Array


def format_samples(law: QuaternionLaw, rate: float, most: int = MAX_ROWS) -> Blocks:
    """The text of the table at `rate` [1/s]: the even grid, whose last row is the last instant.

    Raises:
        InputError: the table would have more rows than `most`.
    """
    refuse_too_many_rows(law.duration, rate, most=most)
    return Blocks(lambda: _format_blocks(law, rate))


def _format_blocks(law: QuaternionLaw, rate: float) -> Iterator[str]:
    with np.errstate(all="ignore"):
        names = tabulate(law, np.zeros(1))
    yield ",".join([*names, "segment", "node"]) + "\n"
    for t in cut_grid(law, rate):
        yield _format_rows(law, t, NEAR_END / rate)


def _format_rows(law: QuaternionLaw, t: Array, near: float) -> str:
    """In the format of each row its segment and node stand already."""
    with np.errstate(all="ignore"):  # what a hostile law overflows is not finite in the file
        numbers = np.column_stack(list(tabulate(law, t).values()))
    row = ",".join(["%.15g"] * numbers.shape[1])
    segments, nodes = number_segments(law, t).tolist(), label_nodes(law, t, near)
    quoted = {label: _quote(label).replace("%", "%%") for label in set(nodes)}
    formats = [f"{row},{k},{quoted[node]}\n" for k, node in zip(segments, nodes, strict=True)]
    return format_rows(numbers, formats)


def write_samples(law: QuaternionLaw, options: Options) -> dict[str, Blocks]:
    """The table as an exporter gives it."""
    return {".csv": format_samples(law, options.rate, options.most)}


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
