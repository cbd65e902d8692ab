"""The tree is the sentence: modules import only what stands before them, heavy packages only where used."""

import ast
import subprocess
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import timelaw

ROOT = Path(timelaw.__file__).parent
# A module imports only from rooms on lines above its own, or to the left on its line. The two wings know
# nothing of each other: what a law is and how it is proved stands apart from how it was found.
PLAN = """
ground:      errors progress interrupts time_limit files results_folder workers units numerics quaternion
vocabulary:  limits least_time easing objectives
law wing:    motion law_file certificate
design wing: problem orientations tours route requirements single_legs nlp through bezier time_law
meeting:     compose compose_bezier proved_passages passing pipeline pipeline_bezier
showing:     report export face study reproduce cli
"""
WINGS = {wing: rooms.split() for wing, rooms in (line.split(":") for line in PLAN.strip().splitlines())}
SENTENCE = [room for rooms in WINGS.values() for room in rooms]
LAW_WING, DESIGN_WING = set(WINGS["law wing"]), set(WINGS["design wing"])
HOMES = {
    "casadi": "nlp",
    "clarabel": "through",
    "matplotlib": "report",
    "PIL": "report",
    "jinja2": "report",
    "click": "cli",
    "rich": "cli",
    "ruamel": "problem",
    "distributed": "study",
    **dict.fromkeys(("fast_tsp", "pydrake", "ruckig", "toppra"), "reproduce"),
}

FACE = ("__version__",)  # what the package itself holds
MOST_TO_READ = 71  # modules


def modules():
    return [p for p in ROOT.rglob("*.py") if p.parent != ROOT or p.stem in SENTENCE]


def imports(path: Path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: a relative import"
            inner = node.module == "timelaw"  # from timelaw import tours
            yield from (f"timelaw.{a.name}" for a in node.names) if inner else (node.module or "",)


def part(path: Path) -> str:
    return path.relative_to(ROOT).parts[0].removesuffix(".py")


def test_every_folder_stands_in_the_sentence():
    assert {part(p) for p in modules()} == set(SENTENCE)


@pytest.mark.parametrize("path", modules(), ids=lambda p: str(p.relative_to(ROOT)))
def test_imports_run_one_way(path):
    for name in imports(path):
        pieces = name.split(".")
        if pieces[0] == "timelaw" and len(pieces) > 1 and pieces[1] not in FACE:
            assert SENTENCE.index(pieces[1]) <= SENTENCE.index(part(path)), name
            assert not {pieces[1]} & LAW_WING or part(path) not in DESIGN_WING, name
        if pieces[0] in HOMES:
            assert part(path) in HOMES[pieces[0]].split(), name


@pytest.mark.parametrize("path", modules(), ids=lambda p: str(p.relative_to(ROOT)))
def test_modules_say_what_they_are_for_and_stay_small(path):
    tree = ast.parse(path.read_text())
    assert ast.get_docstring(tree)
    assert len(path.read_text().splitlines()) <= 250


def module_name(path: Path) -> str:
    name = ".".join(("timelaw", *path.relative_to(ROOT).with_suffix("").parts))
    return name.removesuffix(".__init__")


def test_no_module_needs_itself_to_be_loaded():
    """The graph of imports at module level, that of a package's face included, has no circle."""
    names = {module_name(p): p for p in ROOT.rglob("*.py")}
    needs = {}
    for name, path in names.items():
        found = set()
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("timelaw"):
                for alias in node.names:
                    inner = f"{node.module}.{alias.name}"
                    found.add(inner if inner in names else node.module)
        rooms = {name.rsplit(".", depth)[0] for name in found for depth in range(1, name.count("."))}
        needs[name] = {n for n in found | rooms if n != name and not f"{name}.".startswith(f"{n}.")}
    TopologicalSorter(needs).prepare()


def test_no_function_has_the_name_of_its_module():
    """`import timelaw.route.route` gives a module, and a reader can tell a module from a function."""
    for path in modules():
        for node in ast.parse(path.read_text()).body:
            assert not (isinstance(node, ast.FunctionDef) and node.name == path.stem), path


ANSWERING = ("limits", "motion", "objectives", "easing")  # rooms whose kinds answer for themselves


def kinds() -> dict[str, Path]:
    """Classes of limits, rows, segments, objectives, families and bases, and the file of each."""
    found = {}
    for path in (p for room in ANSWERING for p in (ROOT / room).glob("*.py")):
        for node in ast.parse(path.read_text()).body:
            if isinstance(node, ast.ClassDef):
                found[node.name] = path
    return found


def test_no_code_asks_what_kind_a_thing_is():
    """Neither isinstance, nor type(), nor match on a class of these rooms outside the file that defines it."""
    known = kinds()
    assert {"Arc", "Dwell", "RateRow", "TorqueRow", "Rate", "Momentum", "LeastTime", "SplineFamily"} <= set(
        known
    )
    for path in modules():
        for node in ast.walk(ast.parse(path.read_text())):
            asked = []
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("isinstance", "issubclass"):
                asked = [n.id for n in ast.walk(node.args[1]) if isinstance(n, ast.Name)]
            elif isinstance(node, ast.MatchClass):
                asked = [getattr(node.cls, "id", "")]
            elif isinstance(node, ast.Compare) and "type(" in ast.unparse(node.left):
                asked = [n.id for n in ast.walk(node) if isinstance(n, ast.Name)]
            assert all(known.get(name, path) == path for name in asked), f"{path}:{node.lineno}"


def loaded(code: str) -> set[str]:
    script = f"import sys\n{code}\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize("code", ["import timelaw.cli", "import timelaw.cli.verify"])
def test_help_and_verify_start_without_the_heavy_packages(code):
    assert not loaded(code) & {"casadi", "matplotlib", "scipy", "jinja2"}


def test_help_starts_without_numpy():
    assert "numpy" not in loaded("import timelaw.cli")


@pytest.fixture(scope="module")
def loaded_by_verify():
    return loaded("import timelaw.cli.verify")


def test_verify_loads_nothing_of_how_a_law_is_found(loaded_by_verify):
    parts = {name.split(".")[1] for name in loaded_by_verify if name.startswith("timelaw.")}
    assert not parts & (DESIGN_WING | {"compose", "pipeline"})
    assert not {"ruamel", "casadi", "matplotlib"} & {name.split(".")[0] for name in loaded_by_verify}


def test_a_law_is_verified_without_what_only_shows_or_designs():
    """To the last line that it prints: no module of the problem, none of tables, no solver."""
    law = ROOT.parent / "results" / "paper-24-cell" / "law.json"
    run = f"from timelaw.cli.app import run_command\nassert run_command(['verify', {str(law)!r}]) == 0"
    names = loaded(run)
    assert not names & {f"timelaw.{part}" for part in DESIGN_WING | {"compose", "pipeline", "report"}}
    assert not {"ruamel", "rich", "casadi", "scipy", "matplotlib"} & {name.split(".")[0] for name in names}


def test_what_verify_stands_on_can_be_read_in_an_afternoon(loaded_by_verify):
    own = [name for name in loaded_by_verify if name.split(".")[0] == "timelaw"]
    assert len(own) <= MOST_TO_READ
