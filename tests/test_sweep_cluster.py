"""Sweeps on a Dask cluster: the same bytes, also where a worker is killed; what is wrong with it is said."""

import socket
import subprocess
import sys
import threading
from contextlib import contextmanager

import pytest

from tests.sweeps import list_keys, sweep_here, write_study
from tests.tasks import DEADLY, DEFECT, double
from timelaw.cli.app import run_command
from timelaw.errors import InfeasibleError, InputError
from timelaw.study import plan_study, read_study, run_study
from timelaw.study.executors import open_executor
from timelaw.study.sweep_log import NAME, open_log
from timelaw.study.table import format_study

distributed = pytest.importorskip("distributed", exc_type=ImportError)
pytestmark = pytest.mark.filterwarnings("default")  # those of Dask are its own
WORKER = ("-m", "distributed.cli.dask_worker", "--no-nanny", "--nthreads", "2", "--no-dashboard")


@contextmanager
def open_workers(address, count, folder):
    """Processes that work for a scheduler; one that is killed is not replaced."""
    command = [sys.executable, *WORKER, "--local-directory", str(folder), address]
    crew = [
        subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) for _ in range(count)
    ]
    try:
        yield crew
    finally:
        for process in crew:
            process.kill()
            process.wait()


@contextmanager
def open_scheduler():
    """A scheduler in this process, that workers of other processes reach."""
    options = {"n_workers": 0, "processes": True, "dashboard_address": None, "host": "127.0.0.1"}
    with distributed.LocalCluster(**options, silence_logs=50) as cluster:
        yield cluster


def run_killing(plan, address, log, victim, at):
    """The outcomes of a sweep in the middle of which a worker is killed; how many were done by then."""
    killed = []

    def watch(_stage, done, _of):
        if done >= at and not killed:
            victim.kill()
            killed.append(done)

    with open_executor(None, address) as executor:
        return run_study(plan, executor, log, watch), killed[0]


@pytest.mark.parametrize("count", [40, pytest.param(300, marks=pytest.mark.campaign)])
def test_a_killed_worker_costs_nothing_but_time(tmp_path, count):
    """Complete, no point twice, the bytes of this process; then what cannot be done on what is left."""
    study, output = write_study(tmp_path / "in", count), tmp_path / "out"
    with open_scheduler() as cluster, open_workers(cluster.scheduler_address, 2, tmp_path / "dask") as crew:
        plan = plan_study(read_study(study))
        with open_log(output) as log:
            outcomes, done = run_killing(plan, cluster.scheduler_address, log, crew[0], count // 3)
        assert done < count
        assert crew[0].poll() is not None
        keys = list_keys(output / NAME)
        assert len(keys) == len(set(keys)) == count
        assert format_study(outcomes).encode() == sweep_here(study, tmp_path / "here")
        assert sweep_here(study, output) == (tmp_path / "here" / "sweep.csv").read_bytes()
        refuse_worker(cluster)
        with open_executor(None, cluster.scheduler_address) as executor:
            found = dict(executor(double, [(1,), (DEFECT,)]))
            assert found[0] == 2
            assert "in double" in found[1].__notes__[0]
            cluster.scheduler.allowed_failures = 0
            ((_, killed),) = executor(double, [(DEADLY,)])
            assert isinstance(killed, InfeasibleError)
            assert "ended from outside again and again" in str(killed)
        lose_scheduler(cluster)


def refuse_worker(cluster):
    """The address of a worker is not that of the scheduler."""
    (address,) = [worker.address for worker in cluster.scheduler.workers.values()]
    with pytest.raises(InputError, match=r'no Dask scheduler answers at "tcp.*": it is a Worker'):
        open_executor(None, address).__enter__()


def lose_scheduler(cluster):
    """A cluster that goes away, its workers being gone already, ends the work."""
    with open_executor(None, cluster.scheduler_address) as executor:
        results = executor(double, [(1,), (2,)])
        threading.Timer(0.5, cluster.close).start()
        with pytest.raises(InfeasibleError, match="the cluster gave up its work"):
            next(results)


@pytest.fixture
def closed():
    """An address where nobody listens."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return f"127.0.0.1:{free.getsockname()[1]}"


def test_what_is_wrong_with_a_cluster(tmp_path, closed, capsys, monkeypatch):
    study = write_study(tmp_path, 4)

    def say(*options):
        assert run_command(["sweep", str(study), "-o", str(tmp_path / "o"), *options]) == 2
        assert not (tmp_path / "o").exists()
        return capsys.readouterr().err

    assert f'timelaw: no Dask scheduler answers at "{closed}": ' in say("--cluster", closed)
    assert "unknown address scheme 'foo'" in say("--cluster", "foo://b")
    assert "missing port number" in say("--cluster", "localhost")
    assert "--processes and --cluster exclude each other" in say("--cluster", closed, "--processes", "1")
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert say("--cluster", closed) == 'timelaw: a cluster needs Dask: pip install "timelaw[cluster]"\n'
