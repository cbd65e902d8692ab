"""Signals at chosen moments: exit codes, one object, nothing written, nobody left; see also tests.interrupts."""

import json
import signal
import subprocess
import sys
import time
from textwrap import dedent

import pytest

from tests.tasks import DEADLY, DEFECT, FRAIL, WRONG, double
from timelaw import interrupts
from timelaw.errors import InfeasibleError, InputError
from timelaw.interrupts import Interrupted, check_interrupted, finish_work, shield
from timelaw.workers import run_tasks

AT_MOST = 60  # seconds until a process that should have ended long ago is taken for one that hangs
SIGNALS = pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])


@pytest.fixture
def state(monkeypatch):
    """The state of signals, as in a process that has just begun."""
    fresh = interrupts._State()
    monkeypatch.setattr(interrupts, "_state", fresh)
    return fresh


def listen():
    """A signal as Interrupted may get SIGINT from a shell that ignores it for us."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def start(code):
    """A Python process with our handlers that runs `code`, and says when it has come to `ready()`."""
    script = f"""
import sys, time, ctypes
sys.argv = ["timelaw", "--json"]
from timelaw.cli import entry
from timelaw import interrupts
from timelaw.cli import app
def ready():
    print("ready", file=sys.stderr, flush=True)
def work(arguments):
    {code}
    return 0
app._run = work
entry.main()
"""
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    process = subprocess.Popen([sys.executable, "-c", dedent(script)], text=True, preexec_fn=listen, **pipes)
    assert process.stderr.readline() == "ready\n"
    return process


def end(process):
    out, err = process.communicate(timeout=AT_MOST)
    assert "Traceback" not in err
    return process.returncode, out


WAITING = {
    "in Python": "ready(); time.sleep(100)",
    "in C, which lets threads run": "sleep = ctypes.CDLL(None).sleep; ready(); sleep(100)",
    "taken for a failure": """
    try:
        ready(); time.sleep(100)
    except BaseException:
        raise ImportError("numpy could not be loaded")""",
    "swallowed": """
    try:
        ready(); time.sleep(100)
    except BaseException:
        time.sleep(100)""",
    "shielded": """
    with interrupts.shield():
        ready(); time.sleep(1.0)
    time.sleep(100)""",
}


@SIGNALS
@pytest.mark.parametrize("where", WAITING)
def test_a_signal_ends_the_process_wherever_it_is(number, code, where):
    process = start(WAITING[where])
    process.send_signal(number)
    returned, out = end(process)
    assert returned == code
    assert json.loads(out)["exit_code"] == code


def test_a_second_signal_ends_it_at_once():
    process = start("sleep = ctypes.CDLL(None).sleep; ready(); sleep(100)")
    begun = time.monotonic()
    process.send_signal(signal.SIGTERM)
    time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    returned, out = end(process)
    assert returned == 143
    assert json.loads(out)["errors"][0]["message"] == "terminated"
    assert time.monotonic() - begun < AT_MOST


def test_finished_work_counts():
    process = start("""
    with interrupts.finish_work():
        ready(); time.sleep(0.5)
    print("{}")""")
    process.send_signal(signal.SIGINT)
    assert end(process) == (0, "{}\n")


@SIGNALS
def test_inside_the_construction_of_a_solver(number, code):
    """A program whose construction alone takes seconds, in one call."""
    process = start("""
    import casadi as ca
    x = ca.MX.sym("x", 15000)
    f = ca.sum1(ca.vertcat(*[ca.sin(part) * ca.exp(part) for part in ca.vertsplit(x)]))
    ready()
    with interrupts.shield():
        ca.nlpsol("s", "ipopt", {"x": x, "f": f}, {})""")
    process.send_signal(number)
    returned, out = end(process)
    assert returned == code
    assert json.loads(out)["exit_code"] == code


def test_shields_nest_and_raise_at_the_end(state):
    reached = []

    def work():
        with shield():
            with shield():
                interrupts._note(signal.SIGTERM, None)
            reached.append("between")
        reached.append("after")

    with pytest.raises(Interrupted) as raised:
        work()
    assert reached == ["between"]
    assert raised.value.exit_code == 143
    with pytest.raises(Interrupted):
        check_interrupted()
    assert state.shields == 0


def test_a_signal_before_the_last_step_undoes_it_and_one_in_it_does_not(state):
    with finish_work():
        interrupts._note(signal.SIGINT, None)
    check_interrupted()
    state.number, state.finishing = signal.SIGINT, False
    with pytest.raises(Interrupted), finish_work():
        pytest.fail("the step was begun")


def test_where_the_last_step_fails_the_signal_counts(state):
    def work():
        with finish_work():
            interrupts._note(signal.SIGINT, None)
            raise OSError("full")

    with pytest.raises(OSError, match="full"):
        work()
    assert state.finishing is False
    with pytest.raises(Interrupted):
        check_interrupted()


def test_workers_return_what_is_done_and_what_is_raised():
    assert dict(run_tasks(double, [], 2)) == {}
    found = dict(run_tasks(double, [(0,), (WRONG,), (DEFECT,), (2,)], 2))
    assert (found[0], found[3]) == (0, 4)
    assert isinstance(found[1], InputError)
    assert str(found[1]) == "path:1:2: where: three"
    assert isinstance(found[2], ZeroDivisionError)
    assert "in double" in found[2].__notes__[0]


def test_what_a_killed_worker_did_is_done_again_but_not_for_ever(tmp_path):
    tasks = [(FRAIL, tmp_path / "mark"), (DEADLY,), (1,)]
    found = dict(run_tasks(double, tasks, 1))
    assert (found[0], found[2]) == (12, 2)
    assert isinstance(found[1], InfeasibleError)
    assert "ended from outside (exit code -9), 3 times" in str(found[1])
