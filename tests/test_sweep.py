"""Sweeps: what is known is not done again, every point is a row, and the same table comes whoever did what when."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace
from functools import partial

import pytest

from tests.sweeps import CHEAP, list_keys, sweep_here, write_study
from timelaw.cli.app import run_command
from timelaw.errors import InputError
from timelaw.study import designer, plan_study, read_study, run_study
from timelaw.study.executors import run_here
from timelaw.study.run import MOST_FAILURES
from timelaw.study.sweep_log import NAME
from timelaw.study.table import format_study
from timelaw.workers import try_task

AT_MOST = 300  # seconds until a sweep that should be at work long ago is taken for one that hangs
TRIES = 5  # to interrupt one before it comes to its end: it is short, and a busy machine may look away
DESIGNS = 12
TABLE = CHEAP.replace("list: [[1, 0, 0, 0], [0.8, 0.6, 0, 0], [0, 1, 0, 0]]", "file: t.csv")
ROWS = "w,x,y,z\n1,0,0,0\n0.8,0.6,0,0\n0,1,0,0\n"


def backwards(function, tasks):
    """An executor that does the last first."""
    for number in reversed(range(len(tasks))):
        yield number, try_task(function, tasks[number])


class Counting:
    """An executor that counts what it is asked for."""

    def __init__(self):
        self.tasks = []

    def __call__(self, function, tasks):
        self.tasks.extend(tasks)
        yield from run_here(function, tasks)


def plan(folder, vary, problem=CHEAP):
    folder.mkdir(exist_ok=True)
    (folder / "p.yaml").write_text(problem)
    (folder / "s.yaml").write_text(f"timelaw-study: 1\nname: s\nproblem: p.yaml\nvary: {vary}\n")
    return plan_study(read_study(folder / "s.yaml"))


def test_any_order_gives_the_same_bytes(tmp_path):
    made = plan_study(read_study(write_study(tmp_path, DESIGNS)))
    table = format_study(run_study(made))
    known = {}
    assert format_study(run_study(made, backwards, known)) == table
    assert list(known) == [key for key, _ in reversed(made.points)]
    assert format_study(run_study(made, Counting(), known)) == table


def test_only_what_is_not_known_is_done(tmp_path):
    known, first, second = {}, Counting(), Counting()
    run_study(plan(tmp_path, "{limits.jerk: [600 deg/s^3, 700 deg/s^3, 600 deg/s^3]}"), first, known)
    assert len(first.tasks) == len(known) == 2
    changed = plan(tmp_path, "{limits.jerk: [800 deg/s^3, 700 deg/s^3]}")
    assert (changed.count_known(known), changed.count_unused(known)) == (1, 1)
    outcomes = run_study(changed, second, known)
    assert [task[1] for task in second.tasks] == [{"limits.jerk": "800 deg/s^3"}]
    assert [o.point["limits.jerk"] for o in outcomes] == ["800 deg/s^3", "700 deg/s^3"]
    assert outcomes[0].duration < outcomes[1].duration


def test_a_key_is_of_all_that_an_outcome_depends_on(tmp_path, monkeypatch):
    vary = "{limits.jerk: [600 deg/s^3, 700 deg/s^3], route.closed: [true]}"
    (tmp_path / "t.csv").write_text(ROWS)
    first = [key for key, _ in plan(tmp_path, vary, TABLE).points]
    assert len(set(first)) == 2
    assert [key for key, _ in plan(tmp_path, vary.replace("600", "500"), TABLE).points][1] == first[1]
    turned = "{route.closed: [true], limits.jerk: [700 deg/s^3, 600 deg/s^3]}"
    assert [key for key, _ in plan(tmp_path, turned, TABLE).points] == first[::-1]
    others = [plan(tmp_path, vary, TABLE + "# calmer\n")]
    (tmp_path / "t.csv").write_text(ROWS.replace("0.8,0.6", "0.6,0.8"))
    others.append(plan(tmp_path, vary, TABLE))
    (tmp_path / "t.csv").unlink()
    others.append(plan(tmp_path, vary, TABLE))
    monkeypatch.setattr(designer, "__version__", "99")
    others.append(plan(tmp_path, vary, TABLE))
    found = [key for other in others for key, _ in other.points]
    assert len({*found, *first}) == len(found) + len(first)


def test_what_designs_must_see_what_asks(tmp_path, monkeypatch):
    made = plan(tmp_path, "{limits.jerk: [600 deg/s^3]}")
    monkeypatch.setattr(designer, "__version__", "0.0.1")
    with pytest.raises(
        InputError, match=r"\(timelaw 0.0.1\) has another version of timelaw, or sees another table"
    ):
        run_study(made)


def test_infeasible_and_wrong_points_are_rows(tmp_path, capsys):
    vary = "{objective.total_time: [0.1 s, 9 s, soon], objective.minimise: [jerk]}"
    plan(tmp_path, vary, CHEAP.replace("{basis: double-s}", "{degree: 7}"))
    command = ["sweep", str(tmp_path / "s.yaml"), "-o", str(tmp_path / "o"), "--processes", "1", "--json"]
    assert run_command(command) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["counts"] == {
        "designs": 3,
        "certified": 1,
        "findings": 0,
        "infeasible": 1,
        "wrong": 1,
        "from_log": 0,
    }
    late, good, wrong = told["designs"]
    assert late["failure"] == "infeasible"
    assert good["holds"]
    assert wrong["status"].startswith('objective.total_time: "soon"')
    assert len((tmp_path / "o" / "sweep.csv").read_text().splitlines()) == 4
    assert len(list_keys(tmp_path / "o" / NAME)) == 3


def test_where_every_point_is_wrong_old_results_stay(tmp_path, capsys):
    (tmp_path / "t.csv").write_text(ROWS)
    command = ["sweep", str(tmp_path / "s.yaml"), "-o", str(tmp_path / "o"), "--processes", "1"]
    plan(tmp_path, "{limits.jerk: [600 deg/s^3]}", TABLE)
    assert run_command(command) == 0
    old = (tmp_path / "o" / "sweep.csv").read_bytes()
    (tmp_path / "t.csv").unlink()
    assert run_command(command) == 2
    said = capsys.readouterr().err
    assert "timelaw: no point makes a problem: limits.jerk = 600 deg/s^3: " in said
    assert "t.csv: cannot be read: No such file" in said
    assert (tmp_path / "o" / "sweep.csv").read_bytes() == old
    (tmp_path / "t.csv").write_text(ROWS)
    assert run_command(command) == 0


def test_a_defect_ends_the_sweep_after_the_others(tmp_path, monkeypatch):
    made = plan_study(read_study(write_study(tmp_path, DESIGNS)))
    summarise = designer.summarise_design

    def fail(point, design, allowed=made.points[3:]):
        if point in [given for _, given in allowed]:
            return summarise(point, design)
        raise ZeroDivisionError("ours")

    monkeypatch.setattr(designer, "summarise_design", fail)
    known = {}
    with pytest.raises(ZeroDivisionError, match="ours") as raised:
        run_study(made, known=known)
    assert "in fail" in raised.value.__notes__[0]
    assert list(known) == [key for key, _ in made.points[3:]]
    monkeypatch.setattr(designer, "summarise_design", lambda point, design: fail(point, design, ()))
    counting = Counting()
    with pytest.raises(ZeroDivisionError):
        run_study(made, counting)
    assert MOST_FAILURES < DESIGNS


@pytest.mark.parametrize(
    ("vary", "tour", "most"),
    [
        ("{limits.jerk: [6 rad/s^3, 7 rad/s^3, 8 rad/s^3]}", "shortest", 1),
        ("{limits.jerk: [6 rad/s^3, 7 rad/s^3, 8 rad/s^3]}", "fastest", 3),
        ("{output.rate: [50 Hz, 100 Hz]}", "fastest", 1),
        ("{limits.jerk: [6 rad/s^3, 7 rad/s^3], route.tour: [given, shortest]}", "given", 2),
    ],
)
def test_the_route_is_laid_once_where_the_points_share_it(tmp_path, monkeypatch, vary, tour, most):
    problem = CHEAP.replace("tour: given", f"tour: {tour}")
    made = plan(tmp_path, vary, problem)
    apart = [run_study(replace(made, points=(one,)))[0] for one in made.points]
    made = plan(tmp_path, vary, problem)
    laid = []
    lay_out = designer.lay_out_problem
    monkeypatch.setattr(designer, "lay_out_problem", lambda *given: laid.append(1) or lay_out(*given))
    assert run_study(made) == apart
    assert len(laid) == most


def list_processes(group):
    """The processes of a group that are alive."""
    found = []
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat") as file:
                    state, _, of = file.read().rpartition(")")[2].split()[:3]
            except OSError:
                continue
            if int(of) == group and state != "Z":
                found.append(int(entry))
    return found


def interrupt(study, output, count, number):
    """A sweep that gets a signal when so many outcomes are in its log; None if it came to its end before."""
    command = [sys.executable, "-m", "timelaw", "sweep", study, "-o", output, "--processes", 2, "--json"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "start_new_session": True}
    listen = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)  # as a shell's foreground does
    process = subprocess.Popen([str(word) for word in command], preexec_fn=listen, **pipes)
    ends, log = time.monotonic() + AT_MOST, output / NAME
    while process.poll() is None and (not log.exists() or log.read_bytes().count(b"\n") <= count):
        assert time.monotonic() < ends
        time.sleep(0.005)
    process.send_signal(number)
    out, err = process.communicate(timeout=AT_MOST)
    assert "Traceback" not in err
    if process.returncode == 0:
        return None
    assert process.returncode == (-9 if number == signal.SIGKILL else 128 + number)
    assert number == signal.SIGKILL or json.loads(out)["exit_code"] == process.returncode
    assert number == signal.SIGKILL or "the same command goes on with the others" in err
    while list_processes(process.pid):
        assert time.monotonic() < ends, "workers outlive the sweep"
        time.sleep(0.02)
    return list_keys(log)


def interrupt_often(study, output, count, signals):
    """A sweep that gets one signal after the other and is gone on with between; what it left in the log."""
    for index, number in enumerate(signals):
        least = count * (index + 1) // 5
        done = interrupt(study, output, least, number)
        if done is None:
            shutil.rmtree(output)
            return None
        assert sorted(path.name for path in output.parent.iterdir()) == ["o"]
        assert [path.name for path in output.iterdir()] == [NAME]
        assert least <= len(done) < count
    return done


@pytest.mark.skipif(not os.path.exists("/proc/self/stat"), reason="there is no /proc here")
@pytest.mark.parametrize(
    ("count", "signals"),
    [
        (40, (signal.SIGKILL, signal.SIGINT)),
        pytest.param(300, (signal.SIGKILL, signal.SIGINT, signal.SIGTERM), marks=pytest.mark.campaign),
    ],
)
def test_an_interrupted_sweep_is_gone_on_with(tmp_path, count, signals):
    """Complete, no point twice, the bytes of one that was left alone; no process outlives its parent."""
    study, output = write_study(tmp_path / "in", count), tmp_path / "out" / "o"
    table = sweep_here(study, tmp_path / "whole")
    tries = (interrupt_often(study, output, count, signals) for _ in range(TRIES))
    done = next(found for found in tries if found is not None)
    assert sweep_here(study, output) == table
    assert (output / "front.svg").read_bytes() == (tmp_path / "whole" / "front.svg").read_bytes()
    keys = list_keys(output / NAME)
    assert keys[: len(done)] == done
    assert len(keys) == len(set(keys)) == count
