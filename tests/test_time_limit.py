"""A limit on time: the best certified law by then, or a clear word; and every word of the solver."""

import json
import time
from pathlib import Path

import casadi
import pytest

from timelaw import time_limit
from timelaw.cli.app import _run
from timelaw.easing.time_scaling import used_fraction
from timelaw.errors import InfeasibleError
from timelaw.nlp import exchange, ipopt
from timelaw.nlp.family_choice import list_run_problems
from timelaw.nlp.program import Program
from timelaw.nlp.solution import Status
from timelaw.nlp.verdicts import REMEDIES, Verdict, read_verdict
from timelaw.time_limit import is_late, limit_time, refuse_when_over, set_aside


@pytest.fixture
def overdue(monkeypatch):
    """The time is over as soon as the route is known, whatever the clock says."""
    monkeypatch.setattr("timelaw.cli.design.set_aside", lambda _: time_limit._state.__setattr__("late", 0.0))


def design(tmp_path, capsys, text, *arguments):
    (tmp_path / "p.yaml").write_text(text)
    code = _run(["design", str(tmp_path / "p.yaml"), "-o", str(tmp_path / "out"), "--json", *arguments])
    return code, json.loads(capsys.readouterr().out)


ROUTE = (
    "timelaw: 1\nname: t\nroute: {orientations: {list: [[1,0,0,0], [0.6,0.8,0,0], [0,0,1,0]]}, tour: given}\n"
)
LIMITS = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"
PLAIN = ROUTE + LIMITS


@pytest.mark.usefixtures("overdue")
@pytest.mark.parametrize(
    "more",
    [
        "",
        "objective: {minimise: jerk, total_time: 1.3 x minimum}\n",
        "objective: {minimise: energy, weight: 0.5}\n",
        "easing: {basis: spline, degree: 5, intervals: 10}\n",
        "segments: {1-2: {duration: 9 s}}\n",
    ],
)
def test_the_best_law_by_then_is_certified(tmp_path, capsys, more):
    code, result = design(tmp_path, capsys, PLAIN + more, "--time-limit", "1000")
    assert code == 0
    assert result["stopped_early"] is True
    law = json.loads((tmp_path / "out" / "law.json").read_text())
    assert law["provenance"]["stopped_early"] is True
    assert any("give more time with --time-limit" in s["status"] for s in law["provenance"]["solver"])
    assert law["certificate"]["holds"] is True


@pytest.mark.usefixtures("overdue")
def test_no_further_easings_are_tried(tmp_path, capsys):
    code, result = design(tmp_path, capsys, PLAIN + "easing: {basis: auto, within: 0.1 %}\n")
    assert code == 0
    assert result["certificate"]["holds"] is True


@pytest.mark.usefixtures("overdue")
def test_where_there_is_no_law_yet_that_is_said(tmp_path, capsys):
    text = PLAIN + "nodes: {start: {velocity: 10 deg/s}}\n"
    code, result = design(tmp_path, capsys, text, "--time-limit", "1000")
    assert code == 3
    assert "the time limit ended the search before any law was found" in result["errors"][0]["message"]
    assert not (tmp_path / "out").exists()


# hypothesis times the garbage collector by a callback, in which nothing can be raised: the timer rings again
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_no_route_in_time(tmp_path, capsys):
    code, result = design(tmp_path, capsys, PLAIN, "--time-limit", "0.001")
    assert code == 3
    assert result["errors"][0]["message"].startswith("the time limit ended before the route was known")


def test_enough_time_changes_nothing(tmp_path, capsys):
    def read():
        return {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}

    _, without = design(tmp_path, capsys, PLAIN)
    expected = read()
    _, result = design(tmp_path, capsys, PLAIN, "--time-limit", "1000")
    assert result == without
    assert result["stopped_early"] is False
    assert read() == expected


@pytest.mark.parametrize("given", ["0", "-1", "soon", "nan", "inf"])
def test_a_limit_is_a_positive_number(tmp_path, capsys, given):
    code, result = design(tmp_path, capsys, PLAIN, "--time-limit", given)
    assert code == 2
    assert "--time-limit" in result["errors"][0]["message"]


def test_a_running_solver_stops_within_an_iteration(paper, monkeypatch):
    """Late from its third iteration on: the law it had is stretched to its limits, and called what it is."""
    asked = iter([False] * 4)
    monkeypatch.setattr(ipopt, "is_late", lambda: next(asked, True))
    run = next(r for r in list_run_problems(paper.route, paper.requirements, paper.family) if r.run.angle > 3)
    found = exchange.solve_from(Program((run,)), run.family.start(run.demands))
    assert found is not None
    assert found.status is Status.STOPPED
    assert found.iterations <= 4
    assert used_fraction(run.demands, found.timings) <= 1
    assert found.duration < 2 * run.run.limit


def test_nothing_is_late_without_a_limit():
    assert not is_late()
    set_aside(1e9)
    assert not is_late()
    with limit_time(None):
        assert not is_late()
    with limit_time(1000.0):
        assert not is_late()
        set_aside(1e9)
        assert time_limit._state.over - time_limit._state.late == pytest.approx(500.0)
    with limit_time(1e-9):
        assert is_late()
    assert not is_late()


def test_what_takes_too_long_is_broken_off():
    with limit_time(0.05), pytest.raises(InfeasibleError, match="too long"), refuse_when_over("too long"):
        time.sleep(60)


def test_every_word_of_the_solver_is_known():
    """Those that are compiled into CasADi's interface."""
    library = next(Path(casadi.__file__).parent.glob("*casadi_nlpsol_ipopt*"))
    content = library.read_bytes()
    assert all(verdict.value.encode() in content for verdict in Verdict)
    assert set(REMEDIES) == set(Verdict)
    with pytest.raises(RuntimeError, match='IPOPT ended with "Went_Home", which timelaw does not know'):
        read_verdict("Went_Home")
