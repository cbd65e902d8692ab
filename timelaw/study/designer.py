"""Designs the points of a study, in this process or another, and gives each the key it has in the log."""

import hashlib
import json
import threading
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from timelaw import __version__
from timelaw.errors import Fault, InputError, TimelawError
from timelaw.files import read_bytes
from timelaw.pipeline import Layout, design_layout, lay_out_again, lay_out_problem, share_route
from timelaw.problem import Problem, Source
from timelaw.problem.load import check_problem
from timelaw.study.outcome import Outcome, describe_failure, summarise_design
from timelaw.study.study import Study

MOST_LAYOUTS = 16  # that are kept: a varied key of the route has few values
MOST_TABLE = 200_000_000  # bytes of a table; larger ones are refused when they are read
UNREADABLE = "unreadable"
_solving = threading.Lock()  # solvers keep state of their process; a cluster may call from several threads


@dataclass
class Designer:
    """A problem, and what is kept between its points: layouts, and digests of the tables they name."""

    path: Path
    base: Source
    text_digest: str
    layouts: list[Layout] = field(default_factory=list)
    tables: dict[str, str] = field(default_factory=dict)

    def __call__(self, key: str, point: dict[str, Any]) -> Outcome:
        """Design one point; that it cannot be done is an outcome too.

        Raises:
            InputError: with this key another problem is meant than is seen from here.
        """
        if self.find_key(point) != key:
            message = (
                f"the process that designs (timelaw {__version__}) has another version of timelaw, or sees "
                f"another table beside {self.path} than the one that asks for it"
            )
            raise InputError(Fault(message))
        source = self.base.with_values(point)
        try:
            with _solving:
                layout = self._lay_out(check_problem(source), source)
                return summarise_design(point, design_layout(layout))
        except TimelawError as error:
            return describe_failure(point, error, self.base.path)

    def __reduce__(self) -> tuple[type["Designer"], tuple[Path, Source, str]]:
        """Sent to another process without what is kept, which is found again there."""
        return type(self), (self.path, self.base, self.text_digest)

    def find_key(self, point: dict[str, Any]) -> str:
        """A digest of all that its outcome depends on: the version, the problem, its table, the point."""
        named = any(key.partition(".")[0] == "route" for key in point)
        table = _find_table(self.base.with_values(point).data if named else self.base.data)
        if table not in self.tables:
            self.tables[table] = self._digest_table(table)
        parts = [__version__, self.text_digest, self.tables[table], point]
        return hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode()).hexdigest()

    def _digest_table(self, table: str) -> str:
        if not table:
            return ""
        try:
            return hashlib.sha256(read_bytes(self.path.parent / table, MOST_TABLE)).hexdigest()
        except InputError:  # the design says so where it is read
            return UNREADABLE

    def _lay_out(self, problem: Problem, source: Source) -> Layout:
        """The layout of a point, on a route that is known already if one is."""
        for known in self.layouts:
            if share_route(known.problem, problem):
                return lay_out_again(known, problem, source)
        layout = lay_out_problem(self.path, problem, source)
        self.layouts = [*self.layouts[1 - MOST_LAYOUTS :], layout]
        return layout


def make_designer(study: Study) -> Designer:
    """The designer of a study's points; it holds the problem's data, not the places of its keys."""
    digest = hashlib.sha256(study.base.text.encode("utf-8", "replace")).hexdigest()
    return Designer(study.path.resolve(), replace(study.base, text="", keys={}, values={}), digest)


def _find_table(data: Any) -> str:
    """The file that a problem takes its orientations from, if any."""
    for key in ("route", "orientations", "file"):
        data = data.get(key) if isinstance(data, dict) else None
    return data if isinstance(data, str) else ""
