"""The reference problems against closed forms and linear programs, and the committed results."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.cases import PROBLEMS, reference
from tests.oracles import QUINTIC_PEAKS, LinearProgram, smoothstep_duration
from tests.pages import PAGES
from timelaw import design
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.errors import InputError
from timelaw.export import format_law
from timelaw.law_file import read_law
from timelaw.least_time.double_s import double_s_time
from timelaw.orientations.lattices import make_lattice
from timelaw.report import list_law_rows
from timelaw.reproduce.reference_tables import (
    TOUR_MARK,
    design_tours,
    list_tours,
    replace_table,
    table_references,
    table_tours,
)

DEG = np.pi / 180
RESULTS = Path(__file__).parent.parent / "results"

# name: limits [deg], leg angle [deg], legs, runs by their number of legs,
# double-S stopping and over the runs in closed form by hand where round [s]
CASES = {
    "paper-24-cell": ((60, 120, 600), 120.0, 11, {1: 5, 2: 3}, 29.70, 27.60),
    "spacecraft-24-cell": ((1, 0.05, 0.01), 120.0, 11, {1: 5, 2: 3}, 1595.0, 1520.0),
    "gimbal-600-cell": ((720, 2000, 100000), 72.0, 59, {1: 51, 2: 4}, 23.60, None),
    "imu-calibration-120-cell": ((60, 120, 600), 31.044975628140147, 299, {1: 299}, None, None),
}


def single_and_pair(bounds, angle, lengths):
    """Linear-program optima of one leg, and of two equal legs that share the time evenly."""
    limits = {k: b * DEG for k, b in enumerate(bounds, 1)}
    found = {1: LinearProgram(9, 2, (angle * DEG,), limits).solve()}
    if 2 in lengths:
        found[2] = LinearProgram(9, 2, (angle * DEG,) * 2, limits, (0.5, 0.5)).solve()
    return found


@pytest.mark.parametrize("name", CASES)
def test_reference_problems(name):
    bounds, angle, legs, runs, stopping, limit = CASES[name]
    designed = reference(name)
    assert Counter(len(run.angles) for run in designed.route.runs()) == runs
    np.testing.assert_allclose(designed.route.angles, angle * DEG, rtol=1e-12)
    durations = {entry.name: entry.certificate.duration for entry in designed.laws}
    quintic = legs * smoothstep_duration(QUINTIC_PEAKS, angle, bounds)
    assert durations["quintic"] == pytest.approx(quintic, rel=1e-9)
    if stopping is not None:
        assert durations["double-S, every stop"] == pytest.approx(stopping, rel=1e-9)
    if limit is not None:
        assert durations["double-S"] == pytest.approx(limit, rel=1e-9)
    best = single_and_pair(bounds, angle, runs)
    lower = sum(count * best[length][0] for length, count in runs.items())
    upper = sum(count * best[length][1] for length, count in runs.items())
    assert lower * (1 - 1e-5) <= durations["optimised"] <= upper * (1 + 1e-5)
    assert durations["double-S"] < durations["optimised"] < durations["quintic"]
    assert all(entry.certificate.holds for entry in designed.laws)
    assert all(entry.certificate.continuity.order == 2 for entry in designed.laws)


def test_the_first_steps_file_goes_straight_once():
    designed = reference("first-steps")
    assert designed.optimised.certificate.holds
    assert [node.kind for node in designed.route.nodes] == ["start", "straight", "corner", "corner", "end"]


def test_the_slew_is_bound_by_torque_and_momentum():
    designed = reference("reaction-wheel-slew")
    ratios = {check.limit: check.ratio for check in designed.optimised.certificate.limits}
    assert designed.optimised.certificate.holds
    assert {name for name, ratio in ratios.items() if ratio > 0.999} >= {"torque x", "torque y", "momentum x"}
    # about y: J 10 kg m², so 0.01 rad/s² and 0.05 rad/s under 0.2 deg/s³ for 45 degrees: wheels without net
    # momentum make that the double-S, and the chosen easing comes within one percent of it
    ramp = 0.01 / (0.2 * DEG) + 0.05 / 0.01
    leg = 45 * DEG / 0.05 + ramp
    double_s = next(b.law for b in designed.baselines if b.name == "double-S")
    assert double_s.segments[1].duration == pytest.approx(leg, rel=1e-6)
    assert leg <= designed.optimised.law.segments[1].duration <= 1.01 * leg


def test_the_wrist_is_calm_and_slow_past_the_cable():
    designed = reference("wrist-calibration")
    assert designed.optimised.certificate.holds
    assert designed.optimised.certificate.continuity.order == 3
    rows = {row.name: row for row in list_law_rows(designed)}
    assert rows["optimised"].to_limit < 1.012


def test_the_scan_keeps_its_times():
    designed = reference("camera-scan")
    assert designed.optimised.certificate.holds
    ends = {s.target: s.end_time for s in designed.optimised.law.segments}
    assert ends["2"] == pytest.approx(3, rel=1e-12)
    assert ends["3"] == pytest.approx(5, rel=1e-12)
    assert designed.optimised.law.duration == pytest.approx(16, rel=1e-12)


def test_every_problem_file_is_a_case():
    others = {"first-steps", "reaction-wheel-slew", "wrist-calibration", "camera-scan", "hajsen-zmazek"}
    others |= {"paper-24-cell-through", "imu-calibration-120-cell-through"}
    assert {path.stem for path in PROBLEMS.glob("*.yaml")} == {*CASES, *others}


@pytest.mark.parametrize("path", sorted(RESULTS.glob("*/law.json")), ids=lambda p: p.parent.name)
def test_committed_laws_verify(path):
    law, document = read_law(path)
    certificate = certify(law)
    assert certificate.findings() == []
    assert compare_with_record(certificate, document) == []


TABLES = PAGES["reproducing"]


@pytest.mark.campaign
def test_the_pages_table_is_what_the_command_prints():
    tours = list_tours(sorted(PROBLEMS.glob("*.yaml")))
    designs = [reference(path.stem) for path in tours]
    assert replace_table(TABLES, table_references(designs)) == TABLES


@pytest.mark.parametrize("name", ["paper-24-cell", "spacecraft-24-cell"])
def test_a_row_of_the_pages_table_is_what_the_command_prints(name):
    assert table_references([reference(name)]).splitlines()[-1] in TABLES


def test_ci_runs_the_readmes_test_command():
    command = "python3 -m venv .venv && .venv/bin/pip install -q -e '.[test]' && .venv/bin/pytest\n"
    assert command in PAGES["README"]
    assert (Path(__file__).parent.parent / ".ci" / "run").read_text().endswith(command)


def test_the_pages_table_of_tours():
    """What the command prints; its times by closed forms over runs that SciPy's rotations find."""
    rows = design_tours()
    assert replace_table(TABLES, table_tours(rows), TOUR_MARK) == TABLES
    limits = (60 * DEG, 120 * DEG, 600 * DEG)
    over_runs = {
        ("24-cell", "paper"): 27.60,
        ("24-cell", "fewest-stops"): 26.20,
        ("600-cell", "fewest-stops"): 82.70,
    }
    for name, tour, designed in rows:
        angle = np.degrees(np.min(designed.route.angles))
        lengths = straight_runs(list(designed.tour.order), make_lattice(name))
        assert sum(lengths) == len(make_lattice(name)) - 1
        runs = sum(double_s_time(legs * angle * DEG, *limits) for legs in lengths)
        times = {row.name: row.duration for row in list_law_rows(designed)}
        assert times["double-S"] == pytest.approx(runs, rel=1e-9)
        assert over_runs.get((name, tour), runs) == pytest.approx(runs, rel=1e-9)
        quintic = sum(lengths) * smoothstep_duration(QUINTIC_PEAKS, angle, (60, 120, 600))
        assert times["quintic"] == pytest.approx(quintic, rel=1e-9)
        every = sum(lengths) * double_s_time(angle * DEG, *limits)
        assert times.get("double-S, every stop", runs) == pytest.approx(every, rel=1e-9)
        if name == "600-cell":
            assert (round(every, 2), round(quintic, 2)) == (112.10, 132.75)
        assert times["double-S"] < times["optimised"] < times["quintic"]
        assert designed.optimised.certificate.findings() == []


def straight_runs(order, q):
    """Lengths of the runs of a tour, by SciPy's rotations."""
    rotations = Rotation.from_quat(q[order], scalar_first=True)
    turns = (rotations[:-1].inv() * rotations[1:]).as_rotvec()
    same = np.linalg.norm(np.diff(turns, axis=0), axis=1) < 1e-9
    corners = np.flatnonzero(~same) + 1
    return np.diff([0, *corners, len(turns)])


def test_the_pages_problem_file_is_designed_as_it_stands(tmp_path):
    block = PAGES["problem-file"].split("```yaml\n")[1].split("```")[0]
    (tmp_path / "page.yaml").write_text(block)
    designed = design(tmp_path / "page.yaml")
    assert designed.optimised.certificate.findings() == []


def test_no_law_file_is_written_that_cannot_be_read_again(monkeypatch):
    law, _ = read_law(next(RESULTS.glob("*/law.json")))
    monkeypatch.setattr("timelaw.law_file.read.MOST_PARTS", 100)
    with pytest.raises(InputError, match=r"easing: law.json would hold \d+ values; at most 100 are allowed"):
        format_law(law, certify(law), {})
