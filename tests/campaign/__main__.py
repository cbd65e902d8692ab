"""`python -m tests.campaign --count 1500 --seed 1`: run a campaign, go on with it, or look at one case."""

import argparse
import os
import sys
from pathlib import Path

from tests.campaign.generators import KINDS, make_case
from tests.campaign.judge import FAILED
from tests.campaign.pool import Job, Pool
from tests.campaign.records import append_record, make_record, read_records, summarise, write_failure

INTERRUPTED = 130


def parse(arguments: list[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.campaign", description=__doc__)
    parser.add_argument("--count", type=int, default=1500, help="cases 0 to COUNT - 1 of the seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument(
        "--small", action="store_true", help="few nodes and cheap easings, as the default tests"
    )
    parser.add_argument("--kind", choices=sorted(KINDS), default=None, help="of the problems; else all")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument(
        "--time-limit", type=float, default=120.0, help="CPU time of a case [s]; beyond it hangs"
    )
    parser.add_argument("--out", type=Path, default=None, help="JSON lines; cases in it are not run again")
    parser.add_argument("--failures", type=Path, default=None, help="folder for the problem files that fail")
    parser.add_argument("--case", type=int, default=None, help="print and run this case alone")
    return parser.parse_args(arguments)


def main(arguments: list[str]) -> int:
    """Run what is asked for; 1 if a case failed, 130 if interrupted."""
    options = parse(arguments)
    if options.case is not None:
        print(make_case(options.seed, options.case, small=options.small, kind=options.kind).text)
        numbers, known, out = [options.case], [], None
    else:
        out = options.out or Path(_name_file(options))
        asked = (options.seed, options.small, options.kind)
        known = [r for r in read_records(out) if (r["seed"], r["small"], r.get("kind")) == asked]
        done = {record["case"] for record in known}
        numbers = [k for k in range(options.count) if k not in done]
    folder = options.failures or (out or Path("campaign")).with_suffix("")
    records = [record for record in known if record["case"] < options.count]
    interrupted = _run(options, numbers, records, out, folder)
    print(summarise(records))
    if interrupted:
        return INTERRUPTED
    return int(any(record["verdict"] in FAILED for record in records))


def _name_file(options: argparse.Namespace) -> str:
    """Where records go if nothing is said."""
    parts = [options.seed, options.kind, "small" if options.small else None]
    return "-".join(["campaign", *(str(part) for part in parts if part is not None)]) + ".jsonl"


def _run(
    options: argparse.Namespace, numbers: list[int], records: list[dict], out: Path | None, folder: Path
) -> bool:
    """Run cases, appending to `records`; whether it was interrupted."""
    jobs = [Job(options.seed, number, options.small, options.kind) for number in numbers]
    try:
        with Pool(options.processes, options.time_limit) as pool:
            for job, case, result in pool.run(jobs):
                record = make_record(job, case, result)
                records.append(record)
                if out is not None:
                    append_record(out, record)
                _tell(record, folder, alone=out is None)
    except KeyboardInterrupt:
        return True
    return False


def _tell(record: dict, folder: Path, *, alone: bool) -> None:
    """A line for each case; a failing one prints its problem file."""
    print(
        f"case {record['case']}: {record['generator']}: {record['verdict']} ({record['seconds']:.1f} s)",
        flush=True,
    )
    if alone:
        print("\n".join([*record["findings"], record["message"]]))
    if record["verdict"] in FAILED:
        print(f"  written to {write_failure(folder, record)}")
        if not alone:
            print("\n".join(record["findings"]), record["text"], sep="\n", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
