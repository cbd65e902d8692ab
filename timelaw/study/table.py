"""The outcomes of a study as a table: for people, and as CSV."""

import csv
import io
from collections.abc import Sequence
from typing import Any

from timelaw.study.outcome import Outcome


def list_headings(outcomes: Sequence[Outcome]) -> list[str]:
    """Varied keys, then what was found; limits and efforts that occur anywhere."""
    efforts = list(dict.fromkeys(name for o in outcomes for name in o.efforts))
    peaks = list(dict.fromkeys(name for o in outcomes for name in o.peaks))
    return [
        *outcomes[0].point,
        "certified",
        "time [s]",
        "to limit",
        *(f"{name} effort" for name in efforts),
        *(f"{name} peak/limit" for name in peaks),
        "continuity",
        "easing",
        "status",
    ]


def list_cells(outcome: Outcome, columns: Sequence[str]) -> list[Any]:
    """One row, with nothing where nothing was found."""
    found: dict[str, Any] = {
        **outcome.point,
        "certified": "yes" if outcome.holds else "no",
        "time [s]": outcome.duration,
        "to limit": outcome.to_limit,
        **{f"{name} effort": value for name, value in outcome.efforts.items()},
        **{f"{name} peak/limit": value for name, value in outcome.peaks.items()},
        "continuity": outcome.continuity,
        "easing": outcome.easing,
        "status": outcome.status,
    }
    return ["" if found.get(name) is None else found[name] for name in columns]


def format_study(outcomes: Sequence[Outcome]) -> str:
    """The whole table, numbers to the last digit."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    columns = list_headings(outcomes)
    writer.writerow(columns)
    for outcome in outcomes:
        writer.writerow([repr(c) if isinstance(c, float) else c for c in list_cells(outcome, columns)])
    return text.getvalue()
