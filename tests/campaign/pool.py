"""Each case in a process of its own, which can be killed.

One that takes too long is begun again and told to end in half the time: if it does, it is slow; else it hangs.
"""

import multiprocessing as mp
import os
import signal
import threading
import time
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from multiprocessing.connection import wait

from tests.campaign.generators import Case, make_case
from tests.campaign.judge import HANG, TRACEBACK, Result, judge, judge_hurried

PRELOAD = ["casadi", "scipy.optimize", "scipy.interpolate", "timelaw.report", "tests.campaign.pool"]
WALL = 20.0  # times the CPU time allowed, after which even a sleeping process is given up
FILES_EVERY = {False: 10, True: 30}  # cases, small ones or not, of which all files are made too


@dataclass(frozen=True)
class Job:
    """Which case."""

    seed: int
    number: int
    small: bool = False
    kind: str | None = None
    hurried: bool = False


def work(job: Job, limit: float, pipe) -> None:
    """In the process: make the case, judge it, send both; SIGPROF ends it when its CPU time is used up."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_PROF, limit)
    case = make_case(job.seed, job.number, small=job.small, kind=job.kind)
    if job.hurried:
        result = judge_hurried(case.text, limit / 2)
    else:
        result = judge(case.text, files=job.number % FILES_EVERY[job.small] == 0)
    pipe.send((case, result))
    pipe.close()


def _end_with_parent() -> None:
    """However that ends: nobody waits for the result."""
    mp.parent_process().join()
    os._exit(1)


@dataclass
class _Running:
    job: Job
    process: mp.process.BaseProcess
    pipe: object
    begun: float


class Pool:
    """Runs jobs, so many at once; leaving it kills what it has started."""

    def __init__(self, processes: int, limit: float):
        for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
            os.environ[name] = "1"
        self.context = mp.get_context("forkserver")
        self.context.set_forkserver_preload(PRELOAD)
        self.processes, self.limit = processes, limit
        self.running: list[_Running] = []

    def __enter__(self) -> "Pool":
        return self

    def __exit__(self, *_) -> None:
        for one in self.running:
            one.process.kill()
            one.process.join()

    def run(self, jobs: Iterable[Job], target=work) -> Iterator[tuple[Job, Case, Result]]:
        """Results as they come."""
        waiting = iter(jobs)
        more = True
        while more or self.running:
            while more and len(self.running) < self.processes:
                job = next(waiting, None)
                more = job is not None
                if job is not None:
                    self.running.append(self._start(job, target))
            wait([one.pipe for one in self.running], timeout=0.5)
            for one in list(self.running):
                result = self._collect(one)
                if result is None:
                    continue
                self.running.remove(one)
                again = self.urge(one.job) if one.process.exitcode == -signal.SIGPROF else None
                if again is not None:
                    self.running.append(self._start(again, target))
                else:
                    yield one.job, *result

    def _start(self, job: Job, target) -> _Running:
        here, there = self.context.Pipe(duplex=False)
        process = self.context.Process(target=target, args=(job, self.limit, there), daemon=True)
        process.start()
        there.close()
        return _Running(job, process, here, time.monotonic())

    def _collect(self, one: _Running) -> tuple[Case, Result] | None:
        """What a process has sent, or how it ended; None while it runs."""
        late = time.monotonic() - one.begun > WALL * self.limit
        if not one.pipe.poll() and not late:
            return None
        try:
            sent = None if late else one.pipe.recv()
        except EOFError:
            sent = None
        if late:
            one.process.kill()
        one.process.join()
        if sent is not None:
            return sent
        if late or one.process.exitcode == -signal.SIGPROF:
            return self.give_up(one.job, HANG, f"more than {self.limit:g} s of CPU time", self.limit)
        return self.give_up(one.job, TRACEBACK, f"the process ended with {one.process.exitcode}")

    def urge(self, job: Job) -> Job | None:
        """The job to be begun again where it has used up its time."""
        return None if job.hurried else replace(job, hurried=True)

    def give_up(self, job: Job, verdict: str, finding: str, seconds: float = 0.0):
        """The result of a job whose process has ended without one."""
        case = make_case(job.seed, job.number, small=job.small, kind=job.kind)
        return case, Result(verdict, [finding], seconds=seconds)
