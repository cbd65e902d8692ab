"""The README and the pages of the documentation, the commands they show, and a folder in which these are run."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "timelaw" / "docs"
README = ROOT / "README.md"
PAGES = {page.stem: page.read_text(encoding="utf-8") for page in (README, *sorted(DOCS.glob("*.md")))}
SHELL = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
FENCED = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`((?:timelaw|python -m|pytest) [^`]+)`")
COMMENT = re.compile(r"\s+#.*")
INSTALL = "python3 -m venv .venv && .venv/bin/pip install "  # how a line begins that installs first


def list_lines() -> list[str]:
    """The commands in blocks for the shell, without comments, each once."""
    blocks = (block for text in PAGES.values() for block in SHELL.findall(text))
    lines = (COMMENT.sub("", line).strip() for block in blocks for line in block.splitlines())
    return list(dict.fromkeys(line for line in lines if line))


def list_spans() -> list[str]:
    """The commands that stand in sentences and tables, some with names for what is to be put in, each once."""
    prose = (FENCED.sub("", text) for text in PAGES.values())
    return list(dict.fromkeys(span for text in prose for span in SPAN.findall(text)))


def make_folder(folder: Path) -> Path:
    """A copy of what commands read and write, and an environment whose programs are this tree's."""
    for name in ("problems", "results", "timelaw/docs"):
        shutil.copytree(ROOT / name, folder / name)
    programs = folder / ".venv" / "bin"
    programs.mkdir(parents=True)
    for name, arguments in {"timelaw": "-m timelaw", "python": ""}.items():
        (programs / name).write_text(f'#!/bin/sh\nexec "{sys.executable}" {arguments} "$@"\n')
        (programs / name).chmod(0o755)
    return folder


def run_line(line: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A line as it is typed there, with the environment active."""
    path = f"{folder / '.venv' / 'bin'}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT)}
    command = ["bash", "-c", line]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
