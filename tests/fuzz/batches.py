"""Batches of inputs, each in a process that can be killed: what its inputs are, and what came of each."""

import random
import resource
import signal
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from tests.campaign.pool import Pool
from tests.fuzz.corpus import KINDS, lay_corpus, read_corpus
from tests.fuzz.mutations import mutate
from tests.fuzz.readers import FAILED, Outcome, judge_input

SIZE = 50  # inputs of a batch
MOST_MEMORY = 4_000_000_000  # bytes of address space; beyond, an input ends its process alone
MEGABYTE = 1024  # of the kilobytes that getrusage counts in


@dataclass(frozen=True)
class Batch:
    """Inputs `first` to `first + count - 1` of a seed, all for one reader if it is named."""

    seed: int
    first: int
    count: int
    reader: str | None = None


@dataclass
class Tally:
    """What came of the inputs of a batch: (number, reader, outcome), and the peak memory [MB]; none if it died."""

    outcomes: list[tuple[int, str, Outcome]] = field(default_factory=list)
    peak: float = 0.0
    lost: Outcome | None = None


def make_input(seed: int, number: int, reader: str | None = None) -> tuple[str, str, bytes]:
    """Reader, name of the file it was, and the spoilt content, the same every time."""
    rng = random.Random(f"{seed} {number}")
    kind = reader or KINDS[number % len(KINDS)]
    corpus = read_corpus(kind)
    name = rng.choice(list(corpus))
    others = list(corpus.values())
    if rng.random() < 0.2:
        others += read_corpus(rng.choice(KINDS)).values()
    return kind, name, mutate(rng, corpus[name], others)


def run_batch(batch: Batch, limit: float) -> Tally:
    """Judge every input; the CPU time [s] of each is limited by SIGPROF."""
    tally = Tally()
    with tempfile.TemporaryDirectory() as folder:
        lay_corpus(Path(folder))
        for number in range(batch.first, batch.first + batch.count):
            kind, name, content = make_input(batch.seed, number, batch.reader)
            path = Path(folder) / f"spoilt-{name}"
            path.write_bytes(content)
            signal.setitimer(signal.ITIMER_PROF, limit)
            outcome = judge_input(kind, path)
            signal.setitimer(signal.ITIMER_PROF, 0)
            kept = outcome if outcome.verdict in FAILED else Outcome(outcome.verdict)
            tally.outcomes.append((number, kind, kept))
    tally.peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / MEGABYTE
    return tally


def work(batch: Batch, limit: float, pipe) -> None:
    """In the process: judge the batch and send what came of it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    pipe.send((batch, run_batch(batch, limit)))
    pipe.close()


class BatchPool(Pool):
    """A batch that dies says only how; its inputs are run again one by one."""

    def urge(self, job: Batch) -> None:
        """Nothing that reads is told to end."""

    def give_up(self, job: Batch, verdict: str, finding: str, seconds: float = 0.0):
        """The outcome that ended it."""
        return job, Tally(lost=Outcome(verdict, f"{finding} ({seconds:g} s)"))

    def run_all(self, batches: list[Batch]) -> Iterator[Tally]:
        """What came of all inputs, those of batches that died last."""
        again: list[Batch] = []
        for _, batch, tally in self.run(batches, target=work):
            if tally.lost is None:
                yield tally
            else:
                numbers = range(batch.first, batch.first + batch.count)
                again += [Batch(batch.seed, number, 1, batch.reader) for number in numbers]
        for _, batch, tally in self.run(again, target=work):
            if tally.lost is None:
                yield tally
            else:
                kind = make_input(batch.seed, batch.first, batch.reader)[0]
                yield Tally([(batch.first, kind, tally.lost)])


def split(seed: int, count: int, reader: str | None) -> list[Batch]:
    """Batches of a run."""
    return [Batch(seed, first, min(SIZE, count - first), reader) for first in range(0, count, SIZE)]
