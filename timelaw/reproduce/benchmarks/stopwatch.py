"""CPU seconds of calls in this process, and of other processes with the most memory they held."""

import json
import os
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import timelaw
from timelaw.errors import Fault, InfeasibleError

SHORT = 0.02  # s; a shorter call is repeated within one measurement, far above the clock's step
MOST_CALLS = 100_000
LONG, FEW = 2.0, 3  # s: from there on warming up is nothing, and so many calls are enough
MEGABYTE = 1024.0  # of the KiB that Linux counts
WATCH = Path(__file__).parent / "watch.py"
ENVIRONMENT = {"OMP_NUM_THREADS": "1"}  # a second thread of linear algebra spins, and its seconds count


@dataclass(frozen=True)
class Spent:
    """What a process took: CPU time [s] of itself and its own processes, real time [s], memory [MB]."""

    cpu: float
    real: float
    memory: float


def time_call(call: Callable[[], Any], repeats: int) -> list[float]:
    """CPU seconds of a call, so many times, after one that is not counted; a long one at most thrice."""
    first = _time_calls(call, 1)
    if first > LONG:
        return [first, *(_time_calls(call, 1) for _ in range(min(repeats, FEW) - 1))]
    calls = min(MOST_CALLS, int(SHORT / max(first, SHORT / MOST_CALLS)) + 1)
    return [_time_calls(call, calls) for _ in range(repeats)]


def _time_calls(call: Callable[[], Any], calls: int) -> float:
    begun = time.process_time()
    for _ in range(calls):
        call()
    return (time.process_time() - begun) / calls


def make_environment() -> dict[str, str]:
    """That of other processes: one thread, and this tree's package wherever they run."""
    path = [str(Path(timelaw.__file__).parent.parent), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, **ENVIRONMENT, "PYTHONPATH": os.pathsep.join(filter(None, path))}


def read_memory() -> float:
    """The most memory [MB] that this process has held so far."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEGABYTE


def run_python(arguments: Sequence[str], folder: Path) -> Spent:
    """Run this Python in a folder, on one thread.

    Raises:
        InfeasibleError: it did not end well; with the last line of what it said.
    """
    command = [sys.executable, "-I", "-S", str(WATCH), sys.executable, *arguments]
    done = subprocess.run(
        command, cwd=folder, env=make_environment(), capture_output=True, text=True, check=False
    )
    if done.returncode:
        last = (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]
        raise InfeasibleError(Fault(last, " ".join(arguments)))
    return Spent(**json.loads(done.stdout))
