"""Results on disk, one JSON line a case, the failing ones as problem files too; and the table at the end."""

import json
from collections import Counter, defaultdict
from pathlib import Path

from tests.campaign.generators import Case
from tests.campaign.judge import CERTIFIED, FAILED, VERDICTS, Result
from tests.campaign.pool import Job

SLOWEST = 5


def read_records(path: Path) -> list[dict]:
    """What a file holds; a last line that was cut off is left out."""
    found = []
    for line in path.read_text().splitlines() if path.exists() else []:
        try:
            found.append(json.loads(line))
        except json.JSONDecodeError:
            break
    return found


def make_record(job: Job, case: Case, result: Result) -> dict:
    """A case and its verdict."""
    key = {
        "seed": job.seed,
        "case": job.number,
        "small": job.small,
        "kind": job.kind,
        "generator": case.generator,
    }
    failed = {"text": case.text} if result.failed else {}
    return {**key, **result.to_dict(), **failed}


def append_record(path: Path, record: dict) -> None:
    """As a line of its own, also after one that was cut off."""
    text = path.read_text() if path.exists() else ""
    kept = text if text.endswith("\n") or not text else text[: text.rfind("\n") + 1]
    if kept != text:
        path.write_text(kept)
    with path.open("a") as file:
        file.write(json.dumps(record) + "\n")


def write_failure(folder: Path, record: dict) -> Path:
    """The problem file of a failing case, what is wrong with it as comments."""
    folder.mkdir(parents=True, exist_ok=True)
    says = "\n".join([record["verdict"], *record["findings"], record["message"]])
    comments = "".join(f"# {line}\n" for line in says.splitlines() if line)
    path = folder / f"case-{record['seed']}-{record['case']}{'-small' if record['small'] else ''}.yaml"
    path.write_text(comments + record["text"])
    return path


def summarise(records: list[dict]) -> str:
    """Counts per verdict and generator, the largest jump, the slowest cases, kinds of findings."""
    lines = [f"{'verdict':<22}{'cases':>7}"]
    counts = Counter(record["verdict"] for record in records)
    lines += [f"{verdict:<22}{counts[verdict]:>7}" for verdict in VERDICTS] + [
        f"{'all':<22}{len(records):>7}",
        "",
    ]
    by_kind: dict[str, Counter] = defaultdict(Counter)
    for record in records:
        by_kind[record["generator"].partition("/")[0]][record["verdict"]] += 1
    lines.append(f"{'generator':<14}" + "".join(f"{verdict:>20}" for verdict in VERDICTS))
    lines += [
        f"{kind:<14}" + "".join(f"{c[verdict]:>20}" for verdict in VERDICTS)
        for kind, c in sorted(by_kind.items())
    ]
    designed = [record for record in records if record["verdict"] in (CERTIFIED, *FAILED)]
    if designed:
        worst = max(designed, key=lambda record: record["jump"])
        lines += ["", f"largest jump: {worst['jump']:.3g} of the limit of its order, case {worst['case']}"]
        worst = max(designed, key=lambda record: record.get("beyond", 0.0))
        lines += [f"furthest beyond an arc: {worst.get('beyond', 0.0):.3g} of the leg, case {worst['case']}"]
    lines += ["", "slowest, in s of CPU time (designing alone):"]
    for record in sorted(records, key=lambda record: -record["seconds"])[:SLOWEST]:
        lines.append(
            f"  case {record['case']:<7}{record['seconds']:>8.1f} ({record['designing']:.1f})  {record['generator']}"
        )
    kinds = Counter(kind for record in records if record["verdict"] in FAILED for kind in name_kinds(record))
    if kinds:
        lines += ["", "kinds of findings:"] + [
            f"  {kind:<40}{count:>5}" for kind, count in kinds.most_common()
        ]
    return "\n".join(lines)


def name_kinds(record: dict) -> set[str]:
    """What the findings of a case are about: their first words, or the error of a traceback."""
    if record["verdict"] not in ("wrong", "not certified"):
        last = record["findings"][0].splitlines()[-1] if record["findings"] else ""
        return {f"{record['verdict']}: {last[:60]}"}
    return {finding.split(":")[0].rstrip("0123456789 ") for finding in record["findings"]}
