"""Runs that are alike are solved as one, and sums over runs run by run: the same laws as all together."""

import pytest

from timelaw import design
from timelaw.nlp import all_runs, exchange, optimiser
from timelaw.nlp.alike_runs import AlikeRuns
from timelaw.nlp.solution import Timings
from timelaw.objectives import OBJECTIVES

HEAD = (
    "timelaw: 1\nname: alike\n"
    "route: {orientations: {list: [[0,0,0],[40,0,0],[40,40,0],[40,40,70],[80,40,70],[80,80,70],[80,80,110]], "
    "as: euler, sequence: XYZ, unit: deg}, tour: given}\n"
    "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"
    "easing: {degree: 7}\n"
)


def find(tmp_path, minimise, given):
    """Total time, the objective's value, rows of the largest program."""
    path = tmp_path / "p.yaml"
    path.write_text(HEAD + f"objective: {{minimise: {minimise}, {given}}}\n")
    done = design(path)
    assert done.optimised.certificate.findings() == []
    value = OBJECTIVES[minimise].measure(done.requirements.demands, done.solution.timings)
    return done.optimised.law.duration, value, max(solution.rows for solution in done.solution.solutions)


@pytest.fixture
def one_by_one(monkeypatch):
    """Every run has variables of its own."""
    monkeypatch.setattr(
        exchange, "merge_alike", lambda program: AlikeRuns(program, tuple(range(len(program.runs))))
    )


@pytest.fixture
def together(monkeypatch, one_by_one):  # noqa: ARG001
    """A weight, too, ties all runs into one program."""
    monkeypatch.setattr(
        optimiser, "solve_weighed", lambda *given: [all_runs.solve_together(*given, given=[])]
    )

    def assign(_, solutions):
        return Timings(solutions[0].timings, tuple(solutions), ())

    monkeypatch.setattr(optimiser, "assign_solutions", assign)


@pytest.mark.parametrize(
    ("minimise", "given"),
    [("jerk", "total_time: 10 s"), ("energy", "total_time: 1.3 x minimum"), ("peak", "total_time: 10 s")],
)
def test_alike_runs_solved_as_one_are_as_good(tmp_path, minimise, given, request):
    merged = find(tmp_path, minimise, given)
    request.getfixturevalue("one_by_one")
    apart = find(tmp_path, minimise, given)
    assert merged[:2] == pytest.approx(apart[:2], rel=1e-5)
    assert merged[2] < 0.6 * apart[2]


@pytest.mark.parametrize(("minimise", "weight"), [("jerk", 0.3), ("energy", 5.0)])
def test_with_a_weight_every_run_is_solved_by_itself(tmp_path, minimise, weight, request):
    apart = find(tmp_path, minimise, f"weight: {weight}")
    request.getfixturevalue("together")
    whole = find(tmp_path, minimise, f"weight: {weight}")
    assert apart[:2] == pytest.approx(whole[:2], rel=1e-4)
    assert apart[2] < 0.4 * whole[2]
