"""Seeded random problems, small ones, each judged by oracles that share no code with the program.

`python -m tests.campaign` runs as many more as one likes, and larger ones. A failing case prints itself as a
problem file; with a comment that says what was wrong it becomes one of `tests/regressions`.
"""

import json
import time
from math import inf
from pathlib import Path

import numpy as np
import pytest

from tests.campaign import least, leg_program
from tests.campaign.__main__ import main
from tests.campaign.attitude import about, apart, product, turn
from tests.campaign.generators import KINDS, SCENES, make_case
from tests.campaign.judge import HANG, SLOW, TRACEBACK, WRONG, Result, judge, judge_hurried
from tests.campaign.pool import Job, Pool
from tests.campaign.records import append_record, read_records, summarise
from tests.campaign.refusal import CONFIRMED, UNCONFIRMED, judge_refusal
from tests.campaign.spec import read_spec
from tests.oracles import LinearProgram

SEED, COUNT = 1, 40
FOLDER = Path(__file__).parent / "regressions"
REGRESSIONS = sorted(FOLDER.glob("*.yaml"))
LONG_REGRESSIONS = sorted((FOLDER / "long").glob("*.yaml"))
CPU_LIMIT = 60.0  # s a case


@pytest.fixture(scope="module")
def pool():
    with Pool(1, CPU_LIMIT) as found:
        yield found


@pytest.mark.parametrize("number", range(COUNT))
def test_a_random_problem_is_answered_rightly(number, pool):
    ((_, case, result),) = pool.run([Job(SEED, number, small=True)])
    assert not result.failed, "\n".join([result.verdict, *result.findings, result.message, "", case.text])


@pytest.mark.parametrize("path", REGRESSIONS, ids=lambda path: path.stem)
def test_what_was_answered_wrongly_once_is_right(path):
    result = judge(path.read_text())
    assert not result.failed, "\n".join([result.verdict, *result.findings, result.message])


@pytest.mark.campaign
@pytest.mark.parametrize("path", LONG_REGRESSIONS, ids=lambda path: path.stem)
def test_what_took_too_long_once_is_right(path):
    """Each takes five seconds to a minute and a half."""
    result = judge(path.read_text())
    assert not result.failed, "\n".join([result.verdict, *result.findings, result.message])


def test_a_case_does_not_depend_on_the_others():
    alone = make_case(3, 17)
    assert [make_case(3, k) for k in range(20)][17] == alone
    assert make_case(4, 17).text != alone.text
    assert make_case(3, 17, small=True).text != alone.text


def test_every_generator_and_scene_is_used():
    names = {make_case(SEED, k).generator for k in range(400)}
    assert {name.partition("/")[0] for name in names} == set(KINDS)
    assert {name.partition("/")[2] for name in names} - {""} == set(SCENES)


def sleep(job, limit, pipe):  # noqa: ARG001
    import signal

    signal.setitimer(signal.ITIMER_PROF, 0.3)
    while time.process_time() < 1e9:
        pass


def end_when_told(job, limit, pipe):
    if not job.hurried:
        sleep(job, limit, pipe)
    pipe.send((make_case(job.seed, job.number, small=job.small), Result(SLOW)))


def die(job, limit, pipe):  # noqa: ARG001
    raise SystemExit(3)


@pytest.mark.parametrize(("target", "verdict"), [(sleep, HANG), (end_when_told, SLOW), (die, TRACEBACK)])
def test_a_process_that_never_ends_or_dies_is_a_verdict(target, verdict, pool):
    ((_, case, result),) = pool.run([Job(SEED, 0, small=True)], target)
    assert result.verdict == verdict
    assert case == make_case(SEED, 0, small=True)


@pytest.mark.parametrize("kind", ["passing", "effort", "bezier"])
def test_a_design_that_is_told_to_end_does(kind):
    """With a certified law, or the word that there is none yet."""
    begun = time.monotonic()
    result = judge_hurried(make_case(SEED, 4, kind=kind).text, 0.1)
    assert (result.verdict, result.findings) == (SLOW, [])
    assert time.monotonic() - begun < CPU_LIMIT


def test_a_campaign_goes_on_where_it_was_stopped(tmp_path, capsys):
    out = tmp_path / "c.jsonl"
    usual = ["--small", "--processes", "1", "--out", str(out), "--failures", str(tmp_path / "failures")]
    main([*usual, "--count", "1"])
    first = read_records(out)
    out.write_text(out.read_text() + '{"cut o')
    main([*usual, "--count", "2"])
    records = read_records(out)
    assert records[:1] == first
    assert [record["case"] for record in records] == [0, 1]
    assert f"{'all':<22}{2:>7}" in capsys.readouterr().out


def test_a_failing_case_is_written_as_a_problem_file(tmp_path):
    from tests.campaign.pool import Job
    from tests.campaign.records import make_record, write_failure

    case = make_case(SEED, 0, small=True)
    record = make_record(Job(SEED, 0, small=True), case, Result(WRONG, ["limit: jerk 2 times its bound"]))
    path = write_failure(tmp_path, record)
    assert path.read_text().startswith("# wrong\n# limit: jerk 2 times its bound\n")
    assert read_spec(path.read_text()).data == read_spec(case.text).data
    append_record(tmp_path / "r.jsonl", json.loads(json.dumps(record)))
    assert "limit" in summarise(read_records(tmp_path / "r.jsonl"))


# The oracles themselves


def test_double_s_of_one_limit_alone():
    assert least.double_s(2.0, inf, inf, 3.0) == pytest.approx((32 * 2 / 3) ** (1 / 3), rel=1e-12)
    assert least.double_s(2.0, inf, 3.0, inf) == pytest.approx(2 * (2 / 3) ** 0.5, rel=1e-12)
    assert least.double_s(2.0, 3.0, inf, inf) == pytest.approx(2 / 3, rel=1e-12)


@pytest.mark.parametrize(
    "bounds", [(1.0, 2.0, 10.0), (0.3, 2.0, 10.0), (5.0, 0.5, 100.0), (5.0, 9.0, 1.0), (1.0, 2.0, inf)]
)
def test_phases_travel_the_angle(bounds):
    angle = 1.7
    phases = least.phase_times(angle, *bounds)
    assert sum(phases) == pytest.approx(least.double_s(angle, *bounds), rel=1e-12)
    assert least.angle_after(sum(phases) / 2, angle, *bounds) == pytest.approx(angle / 2, rel=1e-9)


@pytest.mark.parametrize(("order", "cost"), [(2, 12.0), (3, 720.0), (4, 100800.0)])
def test_least_effort_is_that_of_the_smoothstep(order, cost):
    shape = np.polynomial.Polynomial(least.smoothstep(order - 1)).deriv(order)
    whole = (shape**2).integ()
    assert whole(1.0) - whole(0.0) == pytest.approx(cost, rel=1e-9)
    assert least.least_effort(order, order - 1, [1.0], 1.0) == pytest.approx(cost, rel=1e-12)
    unequal, split = [0.3, 1.9], [0.4, 0.6]
    assert least.least_effort(order, order - 1, unequal, 2.0) < sum(
        cost * a**2 / (2 * s) ** (2 * order - 1) for a, s in zip(unequal, split, strict=True)
    )


def test_the_two_linear_programs_agree():
    limits = {1: 1.0, 2: 2.0, 3: 10.0}
    leg = leg_program.Leg(2.0, tuple(limits.items()), (0.0, 0.0), (0.0, 0.0))
    lower, upper = leg_program.least_time(leg, leg_program.Space(7), 1.0, 9.0)
    other = LinearProgram(7, 2, (2.0,), limits).solve()
    assert lower <= upper <= lower * (1 + 1e-5)
    assert (lower + upper) / 2 == pytest.approx(sum(other) / 2, rel=5e-6)


def test_a_linear_program_of_splines_comes_down_to_the_double_s():
    leg = leg_program.Leg(1.0, ((3, 1.0),), (0.0, 0.0), (0.0, 0.0))
    space = leg_program.Space(3, (0.0, 0.25, 0.75, 1.0))
    lower, upper = leg_program.least_factor(leg, 32 ** (1 / 3), space)
    assert lower == pytest.approx(1.0, abs=1e-7)
    assert upper == pytest.approx(1.0, abs=1e-5)


def test_two_legs_in_their_halves_of_the_time_do_no_worse_than_one():
    rest = (0.0, 0.0)
    bounds = ((1, 1.0), (2, 2.0), (3, 10.0))
    space = leg_program.Space(7)
    one = leg_program.least_factor(leg_program.Leg(2.0, bounds, rest, rest), 3.0, space)
    half = leg_program.Leg(1.0, bounds, rest, rest)
    both = leg_program.chain_factor([half, half], [1.5, 1.5], space)
    stopping = leg_program.least_factor(half, 1.5, space)
    assert both[1] <= one[0] * (1 + 1e-5)
    assert both[1] < stopping[0]


def test_a_steady_turn_needs_all_of_its_firm_limit_and_nothing_else():
    leg = leg_program.Leg(2.0, ((1, 0.5), (2, 1.0)), (0.5, 0.0), (0.5, 0.0), frozenset({1}))
    assert leg_program.least_factor(leg, 4.0, leg_program.Space(9))[1] == pytest.approx(0.0, abs=1e-6)
    assert leg_program.least_factor(leg, 3.9, leg_program.Space(9))[0] == inf


def test_quaternions_turn_as_they_should():
    quarter = about(np.array([0.0, 0.0, 1.0]), np.array(np.pi / 2))
    axis, angle = turn(np.array([1.0, 0, 0, 0]), -product(quarter, quarter))
    assert abs(axis[2]) == pytest.approx(1.0)
    assert angle == pytest.approx(np.pi)
    assert float(apart(quarter, -quarter)) == pytest.approx(0.0, abs=1e-12)


REST = """timelaw: 1
name: rest
route: {orientations: {as: rotation-vector, unit: rad, list: [[0, 0, 0], [0, 0, 1], [1, 0, 1]]}}
limits: {jerk: "32 rad/s^3"}
"""


@pytest.mark.parametrize(
    ("more", "message", "verdict"),
    [
        ("", "p:1:1: segments: the solver found no law", WRONG),
        ("segments: {1-2: {duration: 0.5 s}}", "p:1:1: segments: the limits would have to be 0.9 times as large", WRONG),
        ("segments: {1-2: {duration: 9 s}}", "p:1:1: segments: the solver found no law", WRONG),
        ("segments: {1-2: {duration: 0.5 s}}\neasing: {basis: spline, degree: 3}", "p:5:1: segments: the limits would have to be 8 times as large", CONFIRMED),
        ("segments: {1-2: {duration: 0.5 s}}\neasing: {basis: spline, degree: 3}", "p:5:1: segments: the limits would have to be 9 times as large", WRONG),
        ("nodes: {at: {2: {time: 0.9 s}}}\neasing: {basis: spline, degree: 3}", "p:5:1: nodes.at.2.time: 0.9 s is too early for arrival at 2: the earliest possible is 1 s, 0.1 s later", CONFIRMED),
        ("nodes: {at: {2: {time: 0.9 s}}}\neasing: {basis: spline, degree: 3}", "p:5:1: nodes.at.2.time: 0.9 s is too early for arrival at 2: the earliest possible is 1.1 s, 0.2 s later", WRONG),
        ("nodes: {at: {2: {time: 1.02 s}}}\neasing: {basis: spline, degree: 4, intervals: 20}", "p:5:1: nodes.at.2.time: the solver found no law", UNCONFIRMED),
    ],
)  # fmt: skip
def test_a_refusal_is_right_wrong_or_not_known(more, message, verdict):
    assert judge_refusal(read_spec(REST + more + "\n"), message)[0] == verdict
