"""The README and the pages: every command shown is run, every link leads somewhere, every page can be shown."""

import importlib.util
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from tests.browser.chromium import find_chromium
from tests.browser.conftest import MISSING
from tests.cases import PROBLEMS
from tests.pages import DOCS, INSTALL, PAGES, README, ROOT, list_lines, list_spans, make_folder, run_line
from tests.tools import miss
from timelaw.cli import app
from timelaw.limits import LIMITS
from timelaw.objectives import EFFORTS, OBJECTIVES

TESTS = ("pytest", ".venv/bin/pytest")  # these tests themselves, run by who runs them
SHOWN = [line.split(" && ")[-1] if line.startswith(INSTALL) else line for line in list_lines()]
LINES = [line for line in SHOWN if not line.startswith(TESTS)]
LONG = [line for line in LINES if line.startswith(("python -m", "timelaw sweep", "timelaw animate"))]
FIGURED = [span for span in list_spans() if span.startswith("python -m") and "…" not in span]
COUNT = re.compile(r"--count (\d+)")
PART = 100  # of the inputs, problems or rounds that a long test is shown with, one in so many is run here
WIDTH = 80


@pytest.fixture
def folder(tmp_path):
    return make_folder(tmp_path)


def check_line(line, folder):
    """It ends well, and what it names with -o is there."""
    done = run_line(line, folder)
    assert done.returncode == 0, done.stderr
    words = shlex.split(line)
    for option, name in pairwise(words):
        assert option != "-o" or (folder / name).exists()
    return done


@pytest.mark.parametrize("line", [line for line in LINES if line not in LONG], ids=str)
def test_a_command_shown_is_run(line, folder):
    check_line(line, folder)


@pytest.mark.campaign
@pytest.mark.parametrize("line", dict.fromkeys([*LONG, *FIGURED]), ids=str)
def test_a_long_command_shown_is_run(line, folder):
    if "tests.browser" in line and find_chromium() is None:
        miss(MISSING)
    check_line(take_part(line), folder)
    for page in (folder / "timelaw" / "docs").glob("*.md"):  # what remade its tables left all else as it was
        assert strip_tables(page.read_text(encoding="utf-8")) == strip_tables(PAGES[page.stem])


def take_part(line):
    """The same command on less."""
    sets = " --sets 2" if "through_tables" in line else " --quick" if "benchmarks" in line else ""
    return COUNT.sub(lambda count: f"--count {max(2, int(count[1]) // PART)}", line) + sets


def strip_tables(text):
    return re.sub(r"(<!-- [\w ]+: begin -->).*?(<!-- [\w ]+: end -->)", r"\1\2", text, flags=re.DOTALL)


@pytest.mark.campaign
def test_the_first_command_installs_and_designs_and_the_pages_come_along(tmp_path):
    for name in ("timelaw", "problems"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tmp_path)
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    first = next(line for line in list_lines() if line.startswith(INSTALL))
    subprocess.run(["bash", "-c", first], cwd=tmp_path, env=environment, check=True)
    assert (tmp_path / "results" / "paper-24-cell" / "report.html").exists()
    installed = next((tmp_path / ".venv").glob("lib/*/site-packages/timelaw/docs"))
    names = {str(p.relative_to(DOCS)) for p in DOCS.rglob("*") if p.is_file()}
    assert {str(p.relative_to(installed)) for p in installed.rglob("*") if p.is_file()} == names
    shown = subprocess.check_output([".venv/bin/timelaw", "docs", "limits"], cwd=tmp_path, env=environment)
    assert shown.decode() == PAGES["limits"]


def test_there_are_commands_to_be_run():
    assert {line.split()[1] for line in LINES if "timelaw " in line} > {"design", "verify", "tour", "docs"}
    assert not [
        line for line in SHOWN if not line.startswith((".venv/bin/", "timelaw ", "python -m ", "pytest"))
    ]


@pytest.mark.parametrize("span", list_spans())
def test_a_command_in_a_sentence_is_one_that_there_is(span):
    """`timelaw NAME --option`, or a module of this tree with the options that its source names."""
    words = span.split()
    options = {word.strip("[],;") for word in words if word.startswith("--")}
    if words[0] == "timelaw":
        command = app.timelaw.commands[words[1]]
        assert options <= {name for parameter in command.params for name in parameter.opts}
    elif words[0] == "python":
        source = Path(find_main(words[2])).read_text(encoding="utf-8")
        assert all(f'"{option}"' in source for option in options)


def find_main(module):
    found = importlib.util.find_spec(module)
    package = found.submodule_search_locations
    return importlib.util.find_spec(f"{module}.__main__").origin if package else found.origin


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_somewhere(page):
    home = README.parent if page == README.stem else DOCS
    for link in re.findall(r"\]\(([^)]+)\)", PAGES[page]):
        assert "://" in link or (home / link).exists(), link
        is_page = (home / link).parent.resolve() == DOCS and link.endswith(".md")
        assert not is_page or home != DOCS or "/" not in link  # a name that `timelaw docs` takes too


def test_every_page_is_listed_and_shown_as_it_is(capsys):
    assert app.run_command(["docs"]) == 0
    listed = dict(line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines())
    assert listed.keys() == PAGES.keys() - {README.stem}
    for topic, title in listed.items():
        assert f"# {title}\n" == PAGES[topic].splitlines(keepends=True)[0]
        assert f"| `{topic}` |" in PAGES[README.stem]
        for name in (topic, f"{topic}.md"):
            assert app.run_command(["docs", name]) == 0
            assert capsys.readouterr().out == PAGES[topic]


def test_on_a_terminal_it_is_wrapped_and_names_commands_for_links(monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    monkeypatch.setenv("COLUMNS", str(WIDTH))
    monkeypatch.setattr(sys, "stdout", Terminal())
    assert app.run_command(["docs", "limits"]) == 0
    shown = re.sub(r"\x1b\[[\d;]*m", "", sys.stdout.getvalue())
    assert max(map(len, shown.splitlines())) <= WIDTH
    assert "the tours (timelaw docs tours)" in shown
    assert ".md" not in shown
    for block in re.findall(r"```text\n(.*?)```", PAGES["limits"], flags=re.DOTALL):
        assert all(line in shown for line in block.splitlines())  # formulas are not broken


@pytest.mark.parametrize("topic", ["nothing", "README", "../promise", ""])
def test_an_unknown_topic_is_refused_with_what_there_is(topic, capsys):
    assert app.run_command(["docs", topic]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert (
        f'timelaw: docs: "{topic.removesuffix(".md")}" is no topic; there are: architecture, bezier'
        in told.err
    )


def test_the_page_of_limits_has_every_limit_and_objective():
    first_words = {line.split()[0].rstrip(",") for line in PAGES["limits"].splitlines() if line.strip()}
    assert first_words >= {*LIMITS, *OBJECTIVES}
    assert all(effort.symbol in PAGES["limits"] for effort in EFFORTS.values())


def test_terms_are_in_order_and_the_readmes_problem_is_the_shipped_one():
    terms = re.findall(r"^- \*\*(.+?)\*\*", PAGES["terms"], flags=re.MULTILINE)
    assert terms == sorted(terms, key=str.lower)
    assert len(terms) == len(set(terms)) > 30
    block = PAGES[README.stem].split("```yaml\n")[1].split("```")[0]
    assert YAML(typ="safe").load(block) == YAML(typ="safe").load(PROBLEMS / "paper-24-cell.yaml")
