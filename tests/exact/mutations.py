"""`python -m tests.exact.mutations --count 5000 --seed 1`: altered laws, judged and verified.

Certified laws are altered in one respect each, and verified twice: without what they say of themselves,
and with it. None may be accepted of which the judge says that a promise is broken; those are written to a
folder, with the reasons. That more is found than the judge sees is allowed, and counted by kind. The laws
themselves must be accepted. Some ten minutes on one core.
"""

import argparse
import copy
import json
import os
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from random import Random
from typing import Any

import numpy as np

from tests.exact.alterations import ALTERATIONS
from tests.exact.curve_alterations import CURVE_ALTERATIONS, is_curved
from tests.exact.judge import judge
from tests.exact.path_alterations import alter_path, is_path
from tests.exact.problems import GROUPS
from tests.exact.rearrangements import REARRANGEMENTS
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.errors import InputError
from timelaw.law_file import from_document

RECORD = ("certificate", "nodes", "provenance", "timelaw")
ACCEPTED, FOUND, REFUSED, CRASHED = "accepted", "found", "refused", "crashed"
FAILED = ("accepted though broken", "crashed", "a law that is not accepted")
CURVED = 0.5  # of the alterations of laws that have rational segments are such as only these can have
PATHS = 0.5  # and of those that say more of their path, before that
CHUNK = 25  # mutations a process takes at once

Document = dict[str, Any]


@dataclass(frozen=True)
class Outcome:
    """What the verifier did with an altered law, and what the judge says of it."""

    law: str
    kind: str
    with_record: bool
    verdict: str
    findings: list[str]
    broken: list[str]
    document: Document | None = None

    @property
    def row(self) -> str:
        """The row of the table that counts it."""
        if self.verdict in (REFUSED, CRASHED):
            return self.verdict
        if self.broken:
            return "broken, found" if self.verdict == FOUND else FAILED[0]
        if not self.kind:
            return "unaltered, accepted" if self.verdict == ACCEPTED else FAILED[2]
        return "kept, accepted" if self.verdict == ACCEPTED else "kept, found"


def verify(document: Document) -> tuple[str, list[str]]:
    """What `timelaw verify` makes of a document: its verdict, and what it found."""
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            law = from_document(document)
            certificate = certify(law)
        found = [*certificate.findings(), *compare_with_record(certificate, document)]
    except InputError as error:
        return REFUSED, [str(error)]
    except Exception as error:  # whatever it is, it is a crash to report
        return CRASHED, [repr(error)]
    return (FOUND if found else ACCEPTED), found


def strip_record(document: Document) -> Document:
    """The motion alone."""
    return {key: value for key, value in document.items() if key not in RECORD}


def alter(laws: dict[str, Document], seed: int, number: int) -> tuple[str, str, Document]:
    """The altered law of that number: of which law, what was done, and the document."""
    rng = Random(f"{seed}/{number}")
    name = rng.choice(sorted(laws))
    document = copy.deepcopy(laws[name])
    if is_path(document) and rng.random() < PATHS:
        return name, alter_path(rng, document), document
    own = CURVE_ALTERATIONS if is_curved(document) and rng.random() < CURVED else ()
    change = rng.choice(own or (ALTERATIONS if rng.random() < 0.6 else REARRANGEMENTS))
    return name, change(rng, document), document


def examine(name: str, kind: str, document: Document, original: Document) -> list[Outcome]:
    """The outcomes of one altered law, without its record and with it."""
    outcomes = []
    for with_record in (False, True):
        given = document if with_record else strip_record(document)
        verdict, found = verify(given)
        broken = []
        if verdict not in (REFUSED, CRASHED):
            broken = judge(given)
            if with_record and _differ(strip_record(document), strip_record(original)):
                broken.append("P8 the digest is of another motion")
        failed = verdict == CRASHED or (verdict == ACCEPTED and broken)
        outcomes.append(Outcome(name, kind, with_record, verdict, found, broken, given if failed else None))
    return outcomes


def _differ(one: Document, other: Document) -> bool:
    """Whether motions are of other numbers or words; -0.0 is another number than 0.0."""
    skipped = {"duration": None}  # what a file says its duration is, is no part of its digest
    return json.dumps({**one, **skipped}, sort_keys=True) != json.dumps({**other, **skipped}, sort_keys=True)


_laws: dict[str, Document] = {}


def _begin(laws: dict[str, Document]) -> None:
    _laws.update(laws)


def work(case: tuple[int, int]) -> list[Outcome]:
    """In a process: one altered law."""
    name, kind, document = alter(_laws, *case)
    return examine(name, kind, document, _laws[name])


def run(laws: dict[str, Document], seed: int, count: int, processes: int) -> Iterable[Outcome]:
    """The laws themselves, then so many altered ones."""
    for name, document in laws.items():
        yield from examine(name, "", document, document)
    cases = ((seed, number) for number in range(count))
    with get_context("spawn").Pool(processes, _begin, (laws,)) as pool:
        for outcomes in pool.imap(work, cases, CHUNK):
            yield from outcomes


def show(outcomes: list[Outcome]) -> str:
    """Counts by row, without the record and with it, then kinds that were found though nothing is broken."""
    counts = {record: Counter(o.row for o in outcomes if o.with_record is record) for record in (False, True)}
    rows = sorted({row for count in counts.values() for row in count})
    lines = [f"{'':30}{'without record':>15}{'with record':>13}"]
    lines += [f"{row:30}{counts[False][row]:15}{counts[True][row]:13}" for row in rows]
    for row in ("kept, found", *FAILED):
        kinds: dict[str, list[Outcome]] = defaultdict(list)
        for outcome in outcomes:
            if outcome.row == row:
                # of what is allowed the field is enough
                kinds[outcome.kind if row in FAILED else outcome.kind.split(":")[0]].append(outcome)
        lines += [f"\n{row}:"] * bool(kinds)
        for kind, same in sorted(kinds.items(), key=lambda item: -len(item[1])):
            reason = (same[0].broken or same[0].findings)[0]
            lines.append(f"  {len(same):4} {kind} ({same[0].law}): {reason}")
    return "\n".join(lines)


def write_failure(folder: Path, number: int, outcome: Outcome) -> None:
    """The altered law, and beside it why it is broken."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"mutation-{number}.json").write_text(json.dumps(outcome.document))
    reasons = [f"{outcome.law}: {outcome.kind}: {outcome.row}", *outcome.broken, *outcome.findings]
    (folder / f"mutation-{number}.txt").write_text("\n".join(reasons) + "\n")


def main(arguments: list[str]) -> int:
    """Run and show; 1 if a broken law is accepted, or one that is not altered is not."""
    parser = argparse.ArgumentParser(prog="python -m tests.exact.mutations", description=__doc__)
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--failures", type=Path, default=Path("exact-failures"))
    parser.add_argument("--kind", choices=sorted(GROUPS), default=None, help="of the laws; else all")
    options = parser.parse_args(arguments)
    chosen = [options.kind] if options.kind else list(GROUPS)
    laws = {name: law for kind in chosen for name, law in GROUPS[kind]().items()}
    outcomes = list(run(laws, options.seed, options.count, options.processes))
    failed = [outcome for outcome in outcomes if outcome.row in FAILED]
    for number, outcome in enumerate(failed):
        write_failure(options.failures, number, outcome)
    print(show(outcomes))
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
