"""Who designs the points of a study: this process, processes of this machine, or a cluster.

An executor is a function of a function and the tasks it is to be called with; it gives the number of each
task and what the function returned or raised, in whatever order they are done.
"""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

from timelaw.errors import InputError
from timelaw.workers import Results, run_tasks, try_task

Executor = Callable[[Callable[..., Any], Sequence[tuple[Any, ...]]], Results]


def run_here(function: Callable[..., Any], tasks: Sequence[tuple[Any, ...]]) -> Results:
    """One task after the other, in this process."""
    for number, task in enumerate(tasks):
        yield number, try_task(function, task)


@contextmanager
def open_executor(processes: int | None, cluster: str | None) -> Iterator[Executor]:
    """So many processes of this machine, by default one a processor; or the workers of a Dask cluster.

    Raises:
        InputError: both are given, or there is no cluster at this address, or the extra is not installed.
    """
    if cluster is not None:
        if processes is not None:
            raise InputError("--processes and --cluster exclude each other: give one of them")
        from timelaw.study.cluster import open_cluster

        with open_cluster(cluster) as executor:
            yield executor
        return
    processes = processes or os.cpu_count() or 1
    yield run_here if processes == 1 else partial(run_tasks, processes=processes)
