"""The worst that each reader takes, and laws and tables of the largest size, in less than a gigabyte."""

import subprocess
import sys

import pytest

from tests.test_hostile_input import HEAD, SEGMENT, chain, law
from timelaw.law_file.read import MOST_PARTS

MOST_MEMORY = 1000  # MB
PROBE = """
import resource, sys
from pathlib import Path
from timelaw.errors import TimelawError
from {module} import {read}
try:
    {read}(Path(sys.argv[1]))
    print("read")
except TimelawError as error:
    print(len(error.faults))
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""
LAW, TABLE, PROBLEM = ("timelaw.law_file", "read_law"), ("timelaw.orientations.table", "read_table"), ("timelaw.problem", "load_problem")  # fmt: skip
HEAVY = {
    "ten thousand arcs of a kilobyte": (LAW, lambda: law(segments=[SEGMENT | {"pieces": SEGMENT["pieces"] * 3}] * 10_000), "read"),
    "small objects": (LAW, lambda: "[" + '{"":0},' * (MOST_PARTS // 2 - 2) + "{}]", "1"),
    "keys": (LAW, lambda: "{" + ",".join(f'"k{i}":0' for i in range(MOST_PARTS - 9)) + "}", "7"),
    "half a million rows": (TABLE, lambda: "w,x,y,z\n" + "0.6000000000000000000,0.8000000000000000000,0.000000000000000000000,0.00000000000000000\n" * 490_000, "read"),
    "values": (PROBLEM, lambda: HEAD + "x: [" + "1, " * 600_000 + "1]\n", "1"),
    "merge keys": (PROBLEM, lambda: HEAD + chain(1000, "{{<<: [{}]}}"), "1"),
}  # fmt: skip


ALIKE = ("keys", "values")  # others of their kind stay in the default run


@pytest.mark.parametrize(
    "case", [pytest.param(c, marks=pytest.mark.campaign if c in ALIKE else ()) for c in HEAVY]
)
def test_memory_stays_below_a_gigabyte(tmp_path, case):
    (module, read), make, answer = HEAVY[case]
    path = tmp_path / "input"
    path.write_text(make())
    script = PROBE.format(module=module, read=read)
    done = subprocess.run([sys.executable, "-c", script, path], capture_output=True, text=True, check=True)
    said, memory = done.stdout.split()
    assert said == answer
    assert int(memory) < MOST_MEMORY
