"""Where a list of names stands twice, a Literal in a model and a registry that answers to it, they agree."""

from dataclasses import fields
from pathlib import Path
from typing import get_args

import pytest

import timelaw
from tests.cases import PROBLEMS
from timelaw.cli.design import list_files
from timelaw.easing.registry import BASES
from timelaw.export.exporter import Options
from timelaw.export.registry import EXPORTERS
from timelaw.files import write_file
from timelaw.law_file.schema import RatesDocument
from timelaw.limits import LIMITS
from timelaw.limits.torque import ACTUATORS, TORQUE_FORMULAS
from timelaw.motion.kinds import KINDS
from timelaw.motion.segment import RATES
from timelaw.objectives import EFFORTS, OBJECTIVES
from timelaw.orientations.angle_files import READERS
from timelaw.orientations.attitude_files import ATTITUDE_READERS
from timelaw.orientations.forms import FORMS
from timelaw.orientations.lattices import LATTICES
from timelaw.orientations.orientation_set import TRAJECTORY
from timelaw.problem import Problem
from timelaw.problem.body import Body
from timelaw.problem.forms import NEEDS, FormName
from timelaw.problem.limits import Limits
from timelaw.problem.nodes import Nodes
from timelaw.problem.objective import Goal
from timelaw.problem.problem import Baseline, EasingModel
from timelaw.problem.route import SEARCHED, LatticeName, TourName
from timelaw.report.sections import SECTIONS
from timelaw.report.tour_text import ANGLES, WORDS
from timelaw.reproduce.reference_tables import TOURS as TABLED
from timelaw.study.study import StudyModel
from timelaw.time_law import BASELINES
from timelaw.tours.fastest import TIME
from timelaw.tours.merit import LENGTH
from timelaw.tours.straightest import TURNING
from timelaw.tours.tour import TOURS


def choices(model, field):
    """The names a field of a model takes, from its JSON schema."""
    return model.model_json_schema()["properties"][field]["enum"]


PAIRS = {
    "lattices": (get_args(LatticeName), LATTICES),
    "tours": (get_args(TourName), TOURS),
    "searched tours": (SEARCHED, [t for t in TOURS if t not in ("given", "paper")]),
    "forms of orientations": (get_args(FormName), FORMS),
    "forms with more keys": (NEEDS, [form for form in FORMS if form in NEEDS]),
    "baselines": (get_args(Baseline), BASELINES),
    "limits": (Limits.model_fields, LIMITS),
    "objectives": (choices(Goal, "minimise"), OBJECTIVES),
    "efforts": (choices(StudyModel, "effort"), EFFORTS),
    "bases": (choices(EasingModel, "basis"), BASES),
    "keys of easings": ({"basis", *(k for b in BASES.values() for k in b.keys)}, EasingModel.model_fields),
    "actuators": (choices(Body, "actuator"), ACTUATORS),
    "formulas of the actuators": (TORQUE_FORMULAS, ACTUATORS),
    "kinds in the law file": (
        [get_args(kind.document_model.model_fields["kind"].annotation)[0] for kind in KINDS.values()],
        KINDS,
    ),
    "rates in the law file": (RatesDocument.model_fields, RATES.values()),
    "continuity": (get_args(Nodes.model_fields["continuity"].annotation), RATES),
    "lattices of the README": (TABLED, LATTICES),
}


@pytest.mark.parametrize("pair", PAIRS)
def test_a_list_of_names_agrees_with_its_registry(pair):
    names, registry = PAIRS[pair]
    assert set(names) == set(registry)


def test_every_default_of_the_problem_is_a_name_of_its_registry():
    assert set(Problem.model_fields["baselines"].default) <= set(BASELINES)
    assert Goal().minimise in OBJECTIVES
    assert EasingModel().basis in BASES


def test_every_merit_of_a_tour_has_words():
    assert set(WORDS) == {LENGTH, TURNING, TIME}
    assert set(ANGLES) < set(WORDS)


def test_every_section_of_the_report_has_its_template_and_every_template_a_section():
    folder = Path(timelaw.__file__).parent / "report" / "templates" / "sections"
    assert {section.template for section in SECTIONS} == {path.name for path in folder.iterdir()}


@pytest.fixture(scope="module")
def written(paper):
    return set(list_files(paper, PROBLEMS / "paper-24-cell.yaml"))


@pytest.mark.parametrize("name", EXPORTERS)
def test_every_format_writes_a_law_that_designs_write_too_if_it_is_usual(name, paper, written, tmp_path):
    exporter = EXPORTERS[name]
    files = exporter.name_files(paper.optimised.law, Options(10.0))
    assert next(iter(files)) == exporter.file_name
    for name, content in files.items():
        write_file(tmp_path / name, content)
        assert (tmp_path / name).stat().st_size > 500
        assert (name in written) == exporter.usual
    assert set(exporter.takes) <= {field.name for field in fields(Options)}


def test_the_page_of_formats_names_each_with_its_file():
    page = (Path(timelaw.__file__).parent / "docs" / "formats.md").read_text()
    rows = [line.split("|")[1:3] for line in page.splitlines() if line.startswith("| `")]
    named = {cells[0].strip(" `"): cells[1] for cells in rows}
    for name, exporter in EXPORTERS.items():
        assert f"`{exporter.file_name}`" in named[name]
    for suffix in (*READERS, *ATTITUDE_READERS, TRAJECTORY):
        assert f"`{suffix}`" in page


@pytest.mark.parametrize("name", OBJECTIVES)
def test_every_objective_says_what_it_is(name):
    objective = OBJECTIVES[name]
    assert set(objective.takes) <= set(Goal.model_fields)
    assert 1 <= objective.continuity <= max(RATES)
    assert objective.separable == (not objective.takes)
