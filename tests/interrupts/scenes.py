"""What is interrupted: a command, the results that were there before, and those it makes if it is left alone."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from timelaw.results_folder.manifest import MANIFEST
from timelaw.study.sweep_log import NAME as LOG

LEGS = 40  # of the long design: least times one by one, then all together
COUPLED = "objective: {minimise: jerk, total_time: 1.3 x minimum}\n"
LIMITS = "limits: {velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}\n"


@dataclass(frozen=True)
class Scene:
    """A command that writes into `folder`; digests of it before and after; when what was there was replaced [s]."""

    name: str
    command: tuple[str, ...]
    home: Path
    old: str
    new: str
    replaced: float
    duration: float

    @property
    def folder(self) -> Path:
        """Where the results are."""
        return self.home / "out"

    def reset(self) -> None:
        """The old results again, and nothing beside."""
        for path in self.home.iterdir():
            if path.is_dir():
                shutil.rmtree(path)
        shutil.copytree(self.home.parent / f"{self.name}.old", self.folder)


def start(command: tuple[str, ...], home: Path) -> subprocess.Popen[str]:
    """The command in a session of its own, listening to SIGINT as a shell's foreground does."""
    return subprocess.Popen(
        [sys.executable, "-m", "timelaw", *command, "-o", "out", "--json"],
        cwd=home,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def digest(folder: Path) -> str:
    """Of everything in a folder, hidden files too, but for the log of a sweep, which grows before results do."""
    found = hashlib.sha256()
    for path in sorted(folder.rglob("*")):
        if path.name == LOG:
            continue
        found.update(str(path.relative_to(folder)).encode() + b"\0")
        if path.is_file():
            found.update(hashlib.sha256(path.read_bytes()).digest())
    return found.hexdigest()


def make_scenes(base: Path) -> list[Scene]:
    """All scenes, each run once to its end beforehand."""
    rng = np.random.default_rng(1)
    q = rng.normal(size=(LEGS + 1, 4))
    rows = ", ".join(str([float(x) for x in row]) for row in q / np.linalg.norm(q, axis=1, keepdims=True))
    long = f"route: {{tour: given, orientations: {{list: [{rows}]}}}}\n"
    short = "route: {orientations: {lattice: 24-cell}, tour: paper}\n"
    study = "timelaw-study: 1\nname: s\nproblem: p.yaml\nvary: {easing.degree: [7, 9, 11, 13, 15, 17]}\n"
    sweep = ("sweep", "s.yaml", "--processes", "2")
    return [
        _make(base, "short", ("design", "p.yaml"), short),
        _make(base, "long", ("design", "p.yaml"), long + COUPLED),
        _make(base, "sweep", sweep, short, study),
    ]


def _make(base: Path, name: str, command: tuple[str, ...], route: str, study: str = "") -> Scene:
    home = base / name
    home.mkdir()
    head = f"timelaw: 1\nname: p\n{route}{LIMITS}"
    (home / "p.yaml").write_text(head + "easing: {basis: polynomial, degree: 7}\n")
    (home / "s.yaml").write_text(study.replace("[7, 9, 11, 13, 15, 17]", "[8]"))
    _finish(start(("design", "p.yaml"), home))
    (home / "p.yaml").write_text(head)
    if study:
        _finish(start(command, home))
        (home / "s.yaml").write_text(study)
    (home / "out" / "notes.txt").write_text("of the user")
    (home / "out" / "more").mkdir()
    (home / "out" / "more" / "law.json").write_text("of the user too")
    shutil.copytree(home / "out", base / f"{name}.old")
    old = digest(home / "out")
    begun, replaced = time.monotonic(), 0.0
    process, before = start(command, home), os.stat(home / "out" / MANIFEST).st_ino
    while process.poll() is None:
        if not replaced and os.stat(home / "out" / MANIFEST).st_ino != before:
            replaced = time.monotonic() - begun
        time.sleep(0.002)
    _finish(process)
    duration = time.monotonic() - begun
    return Scene(name, command, home, old, digest(home / "out"), replaced or duration, duration)


def _finish(process: subprocess.Popen[str]) -> None:
    out, err = process.communicate()
    if process.returncode:
        raise RuntimeError(f"a scene cannot be made: {out}{err}")
