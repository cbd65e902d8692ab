"""The workers of a Dask cluster as an executor: what one that is killed was doing is done by another."""

import asyncio
import logging
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any
from uuid import uuid4

from timelaw.errors import InfeasibleError, InputError
from timelaw.interrupts import check_interrupted
from timelaw.study.executors import Executor
from timelaw.workers import Results, try_task

CONNECT = 5.0  # seconds in which a scheduler answers, or there is none
LEAVE = 0.5  # seconds to say goodbye to one that may be gone
MISSING = 'a cluster needs Dask: pip install "timelaw[cluster]"'


@contextmanager
def open_cluster(address: str) -> Iterator[Executor]:
    """The workers of the Dask scheduler at an address such as "tcp://10.0.0.1:8786".

    What this process asked for and nobody has begun is given up when it leaves, or is killed.

    Raises:
        InputError: Dask is not installed, or no scheduler answers there.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError(MISSING) from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what matters is raised
    try:
        kind = asyncio.run(asyncio.wait_for(_ask_kind(address), CONNECT))
        if kind != "Scheduler":
            raise ValueError(f"it is a {kind}")
        client = Client(address, timeout=CONNECT, set_as_default=False)
    except (OSError, ValueError) as error:
        check_interrupted()
        text = str(error) or f"it said nothing in {CONNECT:g} s"
        raise InputError(f'no Dask scheduler answers at "{address}": {text}') from None
    try:
        yield partial(_run_on_cluster, client)
    finally:
        client.close(timeout=LEAVE)


async def _ask_kind(address: str) -> str:
    """What answers there; a client is only made for a scheduler, for anything else it might wait for ever."""
    from distributed.core import rpc

    async with rpc(address, timeout=CONNECT) as other:
        return str((await other.identity())["type"])


def _run_on_cluster(client: Any, function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]]) -> Results:
    """The number of each task and what the function returned or raised for it, as they are done."""
    from distributed import as_completed

    if not tasks:
        return
    run = uuid4().hex
    # a task of its own: one that holds it and is killed leaves the scheduler what to make it from again
    shared = client.submit(_keep, function, key=f"timelaw-{run}")
    numbers = {f"timelaw-{run}-{number}": number for number in range(len(tasks))}
    futures = client.map(_try_shared, tasks, function=shared, key=list(numbers))
    for future in as_completed(futures, loop=client.loop):
        yield numbers[future.key], _take(future)
        future.release()


def _keep(function: Callable[..., Any]) -> Callable[..., Any]:
    return function


def _try_shared(task: tuple[Any, ...], function: Callable[..., Any]) -> Any:
    return try_task(function, task)


def _take(future: Any) -> Any:
    """What came of a task.

    Raises:
        InputError: the workers cannot load what is sent to them.
        InfeasibleError: the cluster is gone, or gave the task up.
    """
    from distributed.scheduler import KilledWorker

    if future.status == "finished":
        return future.result()
    if future.status != "error":
        message = f"the cluster gave up its work ({future.status}); the same command goes on when it is back"
        raise InfeasibleError(message)
    error = future.exception()
    if isinstance(error, KilledWorker):
        message = "the workers of the cluster were ended from outside again and again at the same task"
        return InfeasibleError(f"{message}, perhaps for want of memory")
    if isinstance(error, ImportError):
        raise InputError(
            f"the workers of the cluster cannot load timelaw: {error}; install the same version there"
        )
    return error
