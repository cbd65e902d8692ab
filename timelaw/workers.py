"""Work on several processes, which end with the one that started them, however that ends."""

import ctypes
import os
import signal
import sys
import threading
import traceback
from collections import deque
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from multiprocessing import get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from timelaw.errors import InfeasibleError, TimelawError
from timelaw.interrupts import SIGNALS, shield

Results = Generator[tuple[int, Any], None, None]  # the number of a task, and what came of it
PR_SET_PDEATHSIG = 1  # linux/prctl.h
MOST_TRIES = 3  # of a task whose process is killed: by then it is the task that is too much for it


@dataclass(frozen=True, eq=False)
class _Worker:
    """A process, and the pipe that tasks go and results come through."""

    process: BaseProcess
    pipe: Connection


@dataclass(frozen=True)
class _Job:
    """A task, and how often it was begun before this time."""

    number: int
    task: tuple[Any, ...]
    begun: int = 0


def run_tasks(function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]], processes: int) -> Results:
    """The number of each task and what the function returned or raised for it, as they are done.

    The function is sent once to each process, and may keep there what several tasks need. A task whose
    process was ended from outside is begun again by another; that it was `MOST_TRIES` times stands for
    what the function would have returned. Whoever leaves this iterator ends all.
    """
    crew: list[_Worker] = []
    waiting = deque(_Job(number, task) for number, task in enumerate(tasks))
    busy: dict[_Worker, _Job] = {}
    try:
        for _ in range(min(processes, len(tasks))):
            _start(crew)
        for worker in crew:
            _send(worker, function)
            _give(worker, waiting, busy)
        while busy:
            worker = _wait_for_any(list(busy))
            job = busy.pop(worker)
            answer = _receive(worker)
            if answer is None:
                crew.remove(worker)
                answer = _take_up_again(worker, job, waiting)
                if waiting:
                    worker = _start(crew)
                    _send(worker, function)
            _give(worker, waiting, busy)
            if answer is not None:
                yield job.number, answer[0]
    finally:
        for worker in crew:
            worker.process.kill()
        for worker in crew:
            worker.process.join()


def _start(crew: list[_Worker]) -> _Worker:
    """A new process that no signal from the terminal reaches: who ends it is who started it."""
    context = get_context("spawn")
    with shield(), _blocked_signals():
        here, there = context.Pipe()
        process = context.Process(target=_serve, args=(there, os.getpid()), daemon=True)
        process.start()
        crew.append(_Worker(process, here))
        there.close()
    return crew[-1]


@contextmanager
def _blocked_signals() -> Iterator[None]:
    """A process that is started inside never gets these signals; this one gets them later."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # which unblocks them again when it is first needed
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _give(worker: _Worker, waiting: deque[_Job], busy: dict[_Worker, _Job]) -> None:
    """The next job, if one waits."""
    if waiting:
        busy[worker] = waiting.popleft()
        _send(worker, busy[worker].task)


def _send(worker: _Worker, message: Any) -> None:
    """That the process has ended already shows when it is waited for."""
    with suppress(ConnectionError):
        worker.pipe.send(message)


def _wait_for_any(crew: Sequence[_Worker]) -> _Worker:
    """A worker that has sent something, or has ended."""
    ready = wait([worker.pipe for worker in crew])[0]
    return next(worker for worker in crew if worker.pipe is ready)


def _receive(worker: _Worker) -> tuple[Any] | None:
    """What came of a task; None where the process was ended from outside."""
    try:
        return (worker.pipe.recv(),)
    except (EOFError, ConnectionError):
        worker.process.join()
        return None


def _take_up_again(worker: _Worker, job: _Job, waiting: deque[_Job]) -> tuple[InfeasibleError] | None:
    """The job of an ended process waits for another; if it was begun too often, what is said of it."""
    if job.begun + 1 < MOST_TRIES:
        waiting.appendleft(replace(job, begun=job.begun + 1))
        return None
    code = worker.process.exitcode
    message = f"a process was ended from outside (exit code {code}), {MOST_TRIES} times at the same task"
    return (InfeasibleError(f"{message}, perhaps for want of memory; use fewer with --processes"),)


def _serve(pipe: Connection, parent: int) -> None:
    """In the process: do what is sent, first the function, then its tasks, until the parent ends.

    What they need is loaded when they are received: whoever loads it ends with the parent already.
    """
    _end_with(parent)
    with suppress(EOFError):
        function = pipe.recv()
        while True:
            pipe.send(try_task(function, pipe.recv()))


def try_task(function: Callable[..., Any], task: tuple[Any, ...]) -> Any:
    """What the function returns for a task, or the exception it raises, which says where."""
    try:
        return function(*task)
    except TimelawError as error:
        return error
    except Exception as error:
        error.add_note(f"in a process of its own:\n{traceback.format_exc()}")
        return error


def _end_with(parent: int) -> None:
    """End this process as soon as its parent has ended: by the kernel on Linux, elsewhere by a thread."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if hasattr(os, "getppid") and sys.platform != "win32" and os.getppid() != parent:
        os._exit(1)  # it ended before it was asked for
    above = parent_process()
    if above is not None:
        threading.Thread(target=_outlive, args=(above.sentinel,), daemon=True).start()


def _outlive(sentinel: int) -> None:
    wait([sentinel])
    os._exit(1)
