"""The benchmarks: what judges the peers against closed forms, the tables, and the page that holds them."""

import re
import sys

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.pages import DOCS, PAGES
from timelaw.errors import InfeasibleError
from timelaw.reproduce.benchmarks import __main__ as command
from timelaw.reproduce.benchmarks import growth, single_leg
from timelaw.reproduce.benchmarks.parts import PARTS
from timelaw.reproduce.benchmarks.peers import comparison, own, scipy_peer, toppra_peer
from timelaw.reproduce.benchmarks.peers.arcs import Profile, follow_arcs, list_turns
from timelaw.reproduce.benchmarks.peers.judge import difference, judge_motion
from timelaw.reproduce.benchmarks.peers.motion import Course, Motion
from timelaw.reproduce.benchmarks.random_tours import measure_tour, visit_nearest
from timelaw.reproduce.benchmarks.stopwatch import run_python, time_call
from timelaw.reproduce.benchmarks.table import MISSING, Table, format_block, format_spread

PAGE = PAGES["speed"]
DEG = np.pi / 180
LIMITS = (60 * DEG, 120 * DEG, 600 * DEG)


def turn_about_x(*degrees):
    """Nodes at angles about one axis, then about another from the last one on."""
    return Rotation.from_rotvec(np.outer(np.radians(degrees), [1.0, 0.0, 0.0])).as_quat(scalar_first=True)


@pytest.fixture(scope="module")
def course():
    """A leg, one that goes on, and one about another axis."""
    first = Rotation.from_quat(turn_about_x(0, 40, 100), scalar_first=True)
    last = first[2] * Rotation.from_euler("z", 60, degrees=True)
    return Course("bent", Rotation.concatenate([first, last]).as_quat(scalar_first=True), LIMITS)


def test_differences_are_the_rates_of_a_precessing_body():
    """R = exp(at e_z) exp(bt e_x): ω = (b, a sin bt, a cos bt) in body axes, and its derivatives."""
    a, b, h = 0.9, 1.7, 1e-3
    t = np.arange(0.0, 2.0, h)
    about_z, about_x = (Rotation.from_rotvec(np.outer(t, axis)) for axis in ([0, 0, a], [b, 0, 0]))
    q = (about_z * about_x).as_quat(scalar_first=True)
    s, c, blank = np.sin(b * t), np.cos(b * t), np.zeros_like(t)
    rates = (
        np.column_stack([blank + b, a * s, a * c]),
        np.column_stack([blank, a * b * c, -a * b * s]),
        np.column_stack([blank, -a * b**2 * s, -a * b**2 * c]),
    )
    for found, rate in zip(difference(q, 2, h), rates, strict=True):
        np.testing.assert_allclose(found, rate[4:-4], atol=3e-5)


def test_a_quintic_uses_what_closed_forms_say_and_rests_at_every_node(course):
    motion = follow_arcs(course, lambda angle: scipy_peer.ease_quintic(LIMITS, angle), merged=False)
    verdict = judge_motion(motion, course)
    angles = np.array([40, 60, 60]) * DEG
    durations = np.array([scipy_peer.ease_quintic(LIMITS, angle).duration for angle in angles])
    np.testing.assert_allclose(durations, [1.587, 1.875, 1.875], atol=1e-3)  # the jerk; twice 15/8 θ/w
    peaks = [15 / 8, 10 / 3**0.5, 60]
    used = [max(p * angles / durations**k) / LIMITS[k - 1] for k, p in enumerate(peaks, 1)]
    assert verdict.duration == pytest.approx(sum(durations))
    assert verdict.used == pytest.approx(used, rel=6e-3)  # the jerk's peak is at the ends
    assert max(verdict.used) < 1 + 1e-6
    assert verdict.jumping is None
    assert verdict.resting == 4
    assert verdict.deviation < 1e-9
    assert comparison.tell_violation(verdict) == "none"


def test_legs_about_one_axis_are_one_turn(course):
    assert [len(turn.angles) for turn in list_turns(course, merged=True)] == [2, 1]
    motion = follow_arcs(course, lambda angle: scipy_peer.ease_quintic(LIMITS, angle), merged=True)
    assert judge_motion(motion, course).resting == 3
    np.testing.assert_allclose(motion.evaluate(motion.times), course.nodes, atol=1e-9)


def test_a_constant_speed_rests_nowhere_and_jumps_at_corners(course):
    motion = follow_arcs(course, lambda angle: Profile(angle / 0.5, lambda t: 0.5 * t), merged=False)
    verdict = judge_motion(motion, course)
    assert verdict.used[0] == pytest.approx(0.5 / LIMITS[0])
    assert verdict.resting == 0
    assert comparison.tell_violation(verdict) == "ω jumps, α unbounded"


def test_a_way_off_the_arcs_is_measured():
    """A node is missed by ten degrees, and the arc with it."""
    course = Course("straight", turn_about_x(0, 60), LIMITS)
    aside = Rotation.from_euler("z", 10, degrees=True)
    turned = Rotation.from_euler("x", 60, degrees=True) * aside
    q = turned.as_quat(scalar_first=True)
    motion = Motion(np.array([0.0, 1.0]), lambda t: np.where(t[:, None] < 1, course.nodes[0], q))
    assert judge_motion(motion, course).deviation == pytest.approx(10 * DEG)


@pytest.mark.filterwarnings("ignore")  # toppra's own, of the packages it stands on
def test_without_a_limit_of_jerk_toppra_is_the_trapezoid_and_its_acceleration_jumps():
    pytest.importorskip("toppra")
    course = Course("straight", turn_about_x(0, 120), LIMITS)
    motion = follow_arcs(course, lambda angle: toppra_peer.solve_angle(LIMITS, angle), merged=True)
    verdict = judge_motion(motion, course)
    assert verdict.duration == pytest.approx(2 + 0.5, rel=1e-2)  # θ/w + w/α, but for the grid
    assert verdict.used[:2] == pytest.approx((1, 1), rel=1e-3)
    assert comparison.tell_violation(verdict) == "α jumps, jerk unbounded"


def test_timelaw_is_judged_as_the_others(course):
    peer = next(peer for peer in own.PEERS if peer.label == "timelaw, double-S")
    verdict = judge_motion(peer.prepare(course)(), course)
    # θ/w + w/α + α/j for 100°; 60° in two ramps of α/j and a plateau at the greatest rate: 1 + 0.5 + 0.2
    assert verdict.duration == pytest.approx((100 / 60 + 0.7) + (1 + 0.7), rel=1e-9)
    assert verdict.used == pytest.approx((1, 1, 1), rel=1e-4)
    assert verdict.resting == 3


def test_a_peer_that_is_not_there_is_a_row(monkeypatch):
    monkeypatch.setattr(comparison, "find_version", lambda _: None)
    monkeypatch.setattr(comparison, "PEERS", comparison.PEERS[-1:])
    monkeypatch.setattr(comparison, "NAMES", {11: "24-cell"})
    table = comparison.measure(quick=True)
    assert [row[:3] for row in table.rows] == [("SciPy RotationSpline", "24-cell", MISSING)]
    assert {len(row) for row in table.rows} == {len(table.headings)}


def test_a_leg_is_measured_without_peers(monkeypatch):
    monkeypatch.setattr(single_leg, "find_version", lambda _: None)
    monkeypatch.setattr(single_leg, "COUNT", {True: 2})
    monkeypatch.setattr(single_leg, "FAMILIES", {"double-S": single_leg.FAMILIES["double-S"]})
    table = single_leg.measure(quick=True)
    assert [row[:2][-1] == MISSING for row in table.rows] == [False, True, True, True]
    assert table.rows[0][3] == "0.000 %"
    assert {len(row) for row in table.rows} == {len(table.headings)}


def test_a_table_has_its_spread_and_says_on_what_it_was_measured():
    assert format_spread([1400.4, 1380, 1420], 1.0) == "1400 (1380–1420)"
    assert format_spread([0.5], 1e-3) == "500"
    text = format_block(Table(("a", "b"), (("1", "2"),), ("So.",)), "a machine", quick=True)
    assert text == "| a | b |\n|---|---:|\n| 1 | 2 |\n\nMeasured by the quick run on a machine.\n\n- So."


def test_tours_are_measured_by_the_angle_of_the_body():
    nodes = turn_about_x(0, 90, 30, 60)
    assert visit_nearest(nodes) == [0, 2, 3, 1]
    assert measure_tour(nodes, [0, 2, 3, 1]) == pytest.approx(np.pi)
    assert measure_tour(-nodes, [0, 1, 2, 3]) == pytest.approx((90 + 60 + 30 + 60) * DEG)


def test_another_process_is_watched_and_its_fault_told(tmp_path):
    spent = run_python(["-c", "bytearray(60_000_000); print(sum(range(1000)))"], tmp_path)
    assert 0 < spent.cpu < 60
    assert spent.real > 0
    assert 60 < spent.memory < 200
    with pytest.raises(InfeasibleError, match="ValueError: so it is"):
        run_python(["-c", "raise ValueError('so it is')"], tmp_path)
    calls = []
    assert len(time_call(lambda: calls.append(sum(range(100_000))), 3)) == 3


def test_the_page_has_the_table_of_every_part_and_no_other():
    assert re.findall(r"<!-- ([\w ]+): begin -->", PAGE) == list(PARTS)
    for name, part in PARTS.items():
        headings, *rows = growth.read_rows(PAGE, name)
        assert tuple(headings) == part.headings
        assert rows
        assert {len(row) for row in rows} == {len(headings)}
        block = PAGE.partition(f"<!-- {name}: begin -->")[2].partition(f"<!-- {name}: end -->")[0]
        assert re.search(r"^Measured by the (quick|full) run on .*Python 3", block, re.MULTILINE)


def test_every_peer_is_on_the_page_with_how_it_is_set_up():
    for peer in comparison.PEERS:
        assert f"| {peer.label} |" in PAGE
        assert peer.setup in PAGE


def test_the_picture_of_growth_is_of_the_pages_tables(tmp_path):
    assert growth.read_points(PAGE, "routes", "CPU [s]")[0][0] == 10
    assert {degree for *_, degree in [growth.ONLY["coupled"]]} == {"9"}
    (tmp_path / "speed.md").write_text(PAGE, encoding="utf-8")
    growth.draw_page(tmp_path / "speed.md")
    drawn = (tmp_path / "speed" / growth.NAME).read_text(encoding="utf-8")
    shown = (DOCS / "speed" / growth.NAME).read_text(encoding="utf-8")
    assert len(shown) < 60_000
    assert list_texts(drawn) == list_texts(shown)
    assert set(growth.LINES) <= set(list_texts(shown))


def list_texts(svg):
    return re.findall(r"<text[^>]*>([^<]*)</text>", svg)


def test_the_command_rewrites_its_part_of_the_page_alone(tmp_path, monkeypatch):
    page = tmp_path / "speed.md"
    page.write_text(PAGE, encoding="utf-8")
    found = {"start": "| new |", "sweep": None}
    monkeypatch.setattr(command, "measure_part", lambda name, **_: found[name])
    with pytest.raises(InfeasibleError, match="sweep: not measured"):
        command.main([str(page), "--only", "start", "--only", "sweep"])
    changed = page.read_text(encoding="utf-8")
    assert "<!-- start: begin -->\n| new |\n<!-- start: end -->" in changed
    assert changed.partition("<!-- start")[0] == PAGE.partition("<!-- start")[0]


def test_a_part_is_measured_by_a_process_on_one_thread(monkeypatch):
    seen = {}

    def run(arguments, env, **_):
        seen.update(env=env, arguments=arguments)
        return type("Done", (), {"returncode": 0, "stdout": "| a |\n"})

    monkeypatch.setattr(command.subprocess, "run", run)
    assert command.measure_part("start", quick=True) == "| a |"
    assert seen["env"]["OMP_NUM_THREADS"] == "1"
    assert seen["arguments"] == [sys.executable, "-m", command.MODULE, "start", "--quick"]
