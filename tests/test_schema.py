"""`timelaw schema` and `timelaw new`: a foreign validator takes what the program takes, and refuses what a schema can see."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from tests.cases import PROBLEMS
from tests.laws import ROOT
from tests.test_problem_faults import CASES, GOOD
from timelaw.cli.app import run_command
from timelaw.cli.new import KINDS, make_files
from timelaw.cli.schema import SCHEMAS, format_schema
from timelaw.errors import InputError
from timelaw.pipeline import lay_out
from timelaw.problem.load import check_problem
from timelaw.problem.schema_words import WORDS
from timelaw.problem.source import read
from timelaw.study.study import STUDY, read_study

VALIDATORS = {kind: Draft202012Validator(make()) for kind, make in SCHEMAS.items()}
SHIPPED = [*PROBLEMS.glob("*.yaml"), *(ROOT / "tests" / "fuzz" / "corpus" / "problem").glob("*.yaml")]
FOUND = [*(ROOT / "tests" / "regressions").rglob("*.yaml")]
STUDIES = [
    *(PROBLEMS / "studies").glob("*.yaml"),
    *(ROOT / "tests" / "fuzz" / "corpus" / "study").glob("*.yaml"),
]


def plain(text, kind=None):
    """The data of a YAML 1.2 text as JSON has it, with texts for keys."""
    source = read(text, "x.yaml") if kind is None else read(text, "x.yaml", kind)
    return json.loads(json.dumps(source.data))


def faults(kind, data):
    return [error.json_path for error in VALIDATORS[kind].iter_errors(data)]


@pytest.mark.parametrize("kind", SCHEMAS)
def test_schemas_are_schemas_and_the_shipped_ones_are_these(kind):
    Draft202012Validator.check_schema(SCHEMAS[kind]())
    assert (PROBLEMS / f"{kind}.schema.json").read_text() == format_schema(kind)


@pytest.mark.parametrize("path", [*SHIPPED, *FOUND], ids=lambda p: p.stem)
def test_every_problem_that_the_program_reads_validates(path):
    data = plain(path.read_text())
    check_problem(read(path.read_text(), path.name))
    assert faults("problem", data) == []


@pytest.mark.parametrize("path", STUDIES, ids=lambda p: p.stem)
def test_every_study_validates(path):
    assert faults("study", plain(path.read_text(), STUDY)) == []


@pytest.mark.parametrize(
    "path", [*PROBLEMS.glob("*.yaml"), *(PROBLEMS / "studies").glob("*.yaml")], ids=lambda p: p.stem
)
def test_every_shipped_file_names_its_schema_to_editors(path):
    first = path.read_text().splitlines()[0]
    named = path.parent / first.removeprefix("# yaml-language-server: $schema=")
    kind = "study" if path.parent.name == "studies" else "problem"
    assert named.resolve() == (PROBLEMS / f"{kind}.schema.json").resolve()


MORE = {  # shapes that only some files have
    "three bounds": "limits: {velocity: [1 deg/s, 2 deg/s, 3 deg/s]}",
    "everything of a route": "route: {orientations: {list: [[1,0,0,0],[0,1,0,0]], turned: {world: [1,0,0,0]}, symmetry: 432, only: [1, 1-2]}, tour: [1, 2], home: [1,0,0,0]}",
    "columns by number": "route: {orientations: {file: a.csv, as: matrix, columns: [1,2,3,4,5,6,7,8,9]}}",
    "columns by name": "route: {orientations: {file: a.csv, columns: [a, b, c, d]}}",
    "poses": "route: {orientations: {as: matrix, list: [[[1,0,0,0],[0,1,0,0],[0,0,1,0]], [1,0,0,0,-1,0,0,0,-1]]}}",
    "a phase": "route: {orientations: {file: a.ang, phase: 1, unit: deg}}",
    "labels": "route: {orientations: {lattice: 24-cell}, tour: shortest, start: 3, end: '4'}",
    "rates": "motion: through\nnodes: {start: {velocity: [1 deg/s, 0, 2 deg/s]}}",
    "going round": "motion: {kind: through, degree: auto}\nroute: {orientations: {lattice: 24-cell}, closed: true}\nnodes: {start: periodic}",
    "within a part": "easing: {basis: auto, within: 0.01}",
    "within a percentage": "easing: {basis: auto, within: 1 %}",
    "a body": "body: {inertia: [[1 kg*m^2, 0, 0], [0, 1 kg*m^2, 0], [0, 0, 1 kg*m^2]], actuator: wheels, momentum: [0, 0, 0.1 Nms]}",
    "a cycle": "output: {rate: 1 kHz, grid: 4 ms}",
    "a goal": "objective: {minimise: jerk, total_time: 1.5 x minimum}",
    "time": "objective: time",
}  # fmt: skip


def with_more(more):
    data = plain(GOOD)
    return data | json.loads(json.dumps(read(more, "x.yaml").data))


@pytest.mark.parametrize("case", MORE)
def test_every_shape_that_the_program_reads_validates(case):
    data = with_more(MORE[case])
    check_problem(read(json.dumps(data), "x.yaml"))
    assert faults("problem", data) == []


SEEN_BY_THE_PROGRAM_ALONE = {  # dimensions, ranges of quantities, and keys that depend on others
    "not a number",
    "wrong dimension",
    "a frequency is no velocity",
    "zero limit",
    "huge limit",
    "rate out of range",
    "degree too low",
    "degree for continuity",
    "too few intervals",
    "too few intervals for the degree that suits",
}


def test_what_a_schema_can_refuse_it_refuses():
    missed = set()
    for case, (text, _) in CASES.items():
        try:
            data = plain(text)
        except InputError:
            continue  # not YAML, or no mapping: nothing for a schema
        if not faults("problem", data):
            missed.add(case)
    assert missed == SEEN_BY_THE_PROGRAM_ALONE


@pytest.mark.parametrize(
    "text", ["vary: {}", "vary: {a: []}", "vary: {a: {from: 1, to: 2}}", "effort: speed", "more: 1"]
)
def test_malformed_studies_are_refused(text, tmp_path):
    whole = f"timelaw-study: 1\nname: s\nproblem: p.yaml\n{text}\n" + (
        "" if "vary" in text else "vary: {a: [1]}\n"
    )
    assert faults("study", plain(whole, STUDY))
    (tmp_path / "s.yaml").write_text(whole)
    with pytest.raises(InputError):
        read_study(tmp_path / "s.yaml")


@pytest.mark.parametrize("kind", SCHEMAS)
def test_every_key_has_words_and_no_words_are_left_over(kind):
    schema = SCHEMAS[kind]()
    parts = {"Problem" if kind == "problem" else "StudyModel": schema, **schema.get("$defs", {})}
    for name, part in parts.items():
        if "properties" in part:
            assert {key: value["description"] for key, value in part["properties"].items()} == WORDS[name]
    others = {"Problem": "StudyModel", "StudyModel": "Problem"}[next(iter(parts))]
    assert set(parts) | ({others} if kind == "problem" else set(WORDS)) >= set(WORDS)


def test_the_schema_goes_to_stdout_or_a_file(tmp_path, capfd):
    assert run_command(["schema"]) == 0
    assert json.loads(capfd.readouterr().out)["title"] == "timelaw problem file"
    assert run_command(["schema", "study", "-o", str(tmp_path / "s.json")]) == 0
    assert capfd.readouterr().out == ""
    assert json.loads((tmp_path / "s.json").read_text())["title"] == "timelaw study file"


@pytest.mark.parametrize("kind", KINDS)
def test_new_files_are_read_validated_and_laid_out(kind, tmp_path):
    for path, text in make_files(kind, tmp_path / "mine.yaml").items():
        path.write_text(text)
    text = (tmp_path / "mine.yaml").read_text()
    assert text.count("#") > 12
    assert faults("problem", plain(text)) == []
    assert len(lay_out(tmp_path / "mine.yaml").route.legs) > 2
    for line in text.splitlines():  # what is commented out can be let in
        bare = line.strip()
        if (
            bare.startswith("# ")
            and ": " in bare
            and not bare.startswith("# as")
            and "schema" not in bare
            and "Run" not in bare
        ):
            key = bare[2:].split(":")[0]
            assert key in {k for words in WORDS.values() for k in words}, line


def test_new_asks_nothing_on_a_pipe_and_overwrites_nothing(tmp_path):
    command = [sys.executable, "-m", "timelaw", "new"]
    done = subprocess.run(command, input="list\n", capture_output=True, text=True, cwd=tmp_path, check=False)
    assert (done.returncode, done.stdout) == (0, "")
    assert "lattice.yaml: change what you like, then: timelaw design lattice.yaml" in done.stderr
    before = (tmp_path / "lattice.yaml").read_text()
    again = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert again.returncode == 2
    assert "lattice.yaml: is there already; choose another name with -o" in again.stderr
    assert (tmp_path / "lattice.yaml").read_text() == before
    assert {p.name for p in Path(tmp_path).iterdir()} == {"lattice.yaml"}


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals")
def test_new_asks_on_a_terminal(tmp_path):
    ours, theirs = os.openpty()
    command = [sys.executable, "-m", "timelaw", "new"]
    with subprocess.Popen(
        command, stdin=theirs, stderr=theirs, stdout=subprocess.PIPE, cwd=tmp_path
    ) as process:
        os.close(theirs)
        os.write(ours, b"table\n")
        assert process.wait(60) == 0
    os.close(ours)
    assert {p.name for p in tmp_path.iterdir()} == {"table.yaml", "table.csv"}
