"""One round: a scene, a signal at a random moment, and what is wrong with what is left."""

import json
import os
import random
import signal
import subprocess
import time
from dataclasses import dataclass, field

from tests.interrupts.scenes import LOG, Scene, digest, start
from tests.sweeps import list_keys
from timelaw.results_folder import repair_results

KINDS = {
    "SIGINT": (signal.SIGINT,),
    "SIGTERM": (signal.SIGTERM,),
    "SIGKILL": (signal.SIGKILL,),
    "SIGINT twice": (signal.SIGINT, signal.SIGINT),
}
PROMISED = 2.0  # seconds
HANGS = 60.0  # seconds
WRITING = 0.06  # seconds after the first sign of writing, in which half of the signals are sent
LOOK = 0.001  # seconds between two looks for it
BETWEEN = 0.3  # seconds between two signals, at most
OLD, NEW, MIXED = "old", "new", "MIXED"


@dataclass
class Round:
    """What came of it."""

    scene: str
    kind: str
    moment: float
    left: str = ""
    code: int = 0
    seconds: float = 0.0
    sent: bool = True
    faults: list[str] = field(default_factory=list)


def play(scene: Scene, kind: str, rng: random.Random) -> Round:
    """Run the command, send the signal, judge."""
    scene.reset()
    writing = rng.random() < 0.5
    moment = rng.uniform(0.0, WRITING if writing else scene.replaced)
    process, started = start(scene.command, scene.home), time.monotonic()
    while writing and process.poll() is None and not _is_writing(scene):
        time.sleep(LOOK)
    time.sleep(moment)
    done = Round(scene.name, kind, time.monotonic() - started)
    done.sent = process.poll() is None
    begun = time.monotonic()
    for index, number in enumerate(KINDS[kind]):
        if index:
            time.sleep(rng.uniform(0.0, BETWEEN))
        process.send_signal(number)
    last = time.monotonic()
    try:
        out, err = process.communicate(timeout=HANGS)
    except subprocess.TimeoutExpired:
        done.faults.append("hangs")
        process.kill()
        out, err = process.communicate()
    done.seconds = time.monotonic() - (last if kind == "SIGINT twice" else begun)
    done.code = process.returncode
    _judge_words(done, out, err)
    _judge_processes(done, process.pid)
    _judge_folder(done, scene)
    return done


def _is_writing(scene: Scene) -> bool:
    """Whether a hidden folder stands beside the results."""
    return any(name.startswith(".") for name in os.listdir(scene.home))


def _judge_words(done: Round, out: str, err: str) -> None:
    """Exit code, one object, no traceback; a signal in the first moments of Python itself is Python's."""
    first = -int(KINDS[done.kind][0])
    killed = done.kind == "SIGKILL"
    asleep = done.code == first and (killed or not out)  # or before anything of ours was loaded
    if done.code not in (0, 128 - first) and not asleep:
        done.faults.append(f"exit code {done.code}")
    if ("Traceback" in err or "Exception ignored" in err) and not asleep:
        done.faults.append(f"says {err[-300:]!r}")
    if done.code >= 0:
        try:
            told = json.loads(out)["exit_code"]
        except ValueError:
            told = f"{out[:100]!r}"
        if told != done.code:
            done.faults.append(f"object says {told}, exit code {done.code}")
    if done.seconds > PROMISED:
        done.faults.append(f"took {done.seconds:.2f} s")


def _judge_processes(done: Round, group: int) -> None:
    """Nobody of the session lives, after a moment for those whose parent was killed."""
    ends = time.monotonic() + PROMISED
    while _is_alive(group):
        if time.monotonic() > ends:
            done.faults.append("processes are left")
            os.killpg(group, signal.SIGKILL)
            return
        time.sleep(0.02)


def _is_alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def _judge_folder(done: Round, scene: Scene) -> None:
    """Old or new results whole, as the exit code says; nothing beside them once the next run has begun."""
    states = {scene.old: OLD, scene.new: NEW}
    done.left = states.get(digest(scene.folder), MIXED) if scene.folder.exists() else "NOTHING"
    expected = {0: (NEW,), -int(signal.SIGKILL): (OLD, NEW)}.get(done.code, (OLD,))
    if done.kind == "SIGINT twice" and done.code == 130:  # the second may find them in their place already
        expected = (OLD, NEW)
    if done.left not in expected:
        done.faults.append(f"exit code {done.code}, {done.left} results")
    beside = [path.name for path in scene.home.iterdir() if path.name.startswith(".")]
    if beside and done.code != -int(signal.SIGKILL) and done.kind != "SIGINT twice":
        done.faults.append(f"{beside} left")
    repair_results(scene.folder)
    if states.get(digest(scene.folder), MIXED) != done.left:
        done.faults.append("the next run changes the results")
    if any(path.name.startswith(".") for path in scene.home.iterdir()):
        done.faults.append("the next run leaves something beside")
    if (scene.folder / LOG).exists():
        _judge_log(done, scene)


def _judge_log(done: Round, scene: Scene) -> None:
    """What an interrupted sweep left in its log is kept, and the next one does the rest, nothing twice."""
    left = list_keys(scene.folder / LOG)
    out, err = start(scene.command, scene.home).communicate(timeout=HANGS)
    keys = list_keys(scene.folder / LOG)
    if digest(scene.folder) != scene.new:
        done.faults.append(f"going on does not end with the new results: {out[-300:]!r} {err[-300:]!r}")
    if keys[: len(left)] != left or len(set(keys)) < len(keys):
        done.faults.append(
            f"a log of {len(left)} outcomes became one of {len(keys)}, {len(set(keys))} of them apart"
        )
