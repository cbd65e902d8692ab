"""Work on several processes, which end with the one that started them, however that ends."""

import ctypes
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from timelaw.errors import InfeasibleError, TimelawError
from timelaw.interrupts import SIGNALS, shield

PR_SET_PDEATHSIG = 1  # linux/prctl.h


@dataclass(frozen=True)
class _Worker:
    """A process, and the pipe that tasks go and results come through."""

    process: BaseProcess
    pipe: Connection


def run_tasks(
    function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]], processes: int
) -> Iterator[tuple[int, Any]]:
    """The number of each task and what the function returns for it, as they are done; left, it ends all.

    Raises:
        Exception: what the function raised.
        InfeasibleError: a process was ended from outside.
    """
    crew: list[_Worker] = []
    try:
        for _ in range(processes):
            _start(crew)
        waiting = iter(enumerate(tasks))
        for worker in crew:
            _give(worker, function, next(waiting, None))
        for _ in tasks:
            worker = _wait_for_any(crew)
            number, result, error = _receive(worker)
            if error is not None:
                raise error
            _give(worker, function, next(waiting, None))
            yield number, result
    finally:
        for worker in crew:
            worker.process.kill()
        for worker in crew:
            worker.process.join()


def _start(crew: list[_Worker]) -> None:
    """A new process that no signal from the terminal reaches: who ends it is who started it."""
    context = get_context("spawn")
    with shield(), _blocked_signals():
        here, there = context.Pipe()
        process = context.Process(target=_serve, args=(there, os.getpid()), daemon=True)
        process.start()
        crew.append(_Worker(process, here))
        there.close()


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


def _give(worker: _Worker, function: Callable[..., Any], task: tuple[int, tuple[Any, ...]] | None) -> None:
    if task is not None:
        worker.pipe.send((function, *task))


def _wait_for_any(crew: Sequence[_Worker]) -> _Worker:
    """A worker that has sent something, or has ended."""
    ready = wait([worker.pipe for worker in crew])[0]
    return next(worker for worker in crew if worker.pipe is ready)


def _receive(worker: _Worker) -> tuple[int, Any, Exception | None]:
    try:
        number, result, error = worker.pipe.recv()
    except (EOFError, ConnectionError):
        worker.process.join()
        code = worker.process.exitcode
        message = f"a process was ended from outside (exit code {code}), perhaps for want of memory"
        raise InfeasibleError(f"{message}; use fewer with --processes") from None
    return number, result, error


def _serve(pipe: Connection, parent: int) -> None:
    """In the process: do what is sent, until the parent ends."""
    _end_with(parent)
    while True:
        try:
            function, number, task = pipe.recv()
        except EOFError:
            return
        answer: tuple[int, Any, Exception | None]
        try:
            answer = number, function(*task), None
        except TimelawError as error:
            answer = number, None, error
        except Exception as error:
            error.add_note(f"in a process of its own:\n{traceback.format_exc()}")
            answer = number, None, error
        pipe.send(answer)


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
