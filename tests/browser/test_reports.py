"""Whole reports in the browser: of arcs and of Bézier curves, with dwells, axes and torque, and long ones."""

from pathlib import Path

import numpy as np
import pytest

from tests.browser.layout import WIDTHS, measure_layout
from tests.cases import PROBLEMS, unit_quaternions
from tests.curves import PLACES, TURNS, curve, make
from timelaw import design
from timelaw.pipeline_bezier import BezierDesign
from timelaw.report import render_report
from timelaw.report.curves.page import render_curve_report

DIGEST = "sha256:0"
LIMITS = {"velocity": "60 deg/s", "acceleration": "120 deg/s^2", "jerk": "600 deg/s^3"}
AXES = {
    "limits": {**LIMITS, "velocity": ["60 deg/s", "50 deg/s", "40 deg/s"], "torque": "15 N*m"},
    "body": {"inertia": ["12 kg*m^2", "10 kg*m^2", "8 kg*m^2"]},
    "nodes": {"dwell": "4 s"},
}
SHIPPED = sorted(path.stem for path in PROBLEMS.glob("*.yaml"))


def write(designed, path: Path) -> Path:
    """The report of a design."""
    render = render_curve_report if isinstance(designed, BezierDesign) else render_report
    path.write_text(render(designed, DIGEST)["report.html"], encoding="utf-8")
    return path


def design_set(count: int, **more):
    """A problem of so many random orientations in random order, eased by the quintic alone if there are many."""
    nodes = unit_quaternions(np.random.default_rng(count), count)
    return design(
        {
            "timelaw": 1,
            "name": f"set-{count}",
            "route": {"orientations": {"list": nodes.tolist()}, "tour": "given"},
            "limits": LIMITS,
            "easing": {"basis": "polynomial", "degree": 5},
            "baselines": ["quintic", "double-s"],
            **more,
        }
    )


@pytest.fixture(scope="module", params=["arcs", "curves", "dwells"])
def page(request, paper, tmp_path_factory):
    designs = {
        "arcs": lambda: paper,
        "curves": lambda: make([curve(TURNS[:2], PLACES[:2])]),
        "dwells": lambda: design_set(5, **AXES),
    }
    return write(designs[request.param](), tmp_path_factory.mktemp("report") / "report.html")


@pytest.mark.parametrize("width", WIDTHS)
def test_the_body_moves_in_it_and_nothing_is_complained_of(browser, page, width):
    browser.open(page, width)
    assert browser.evaluate("document.querySelectorAll('.motion.ready').length") == 1
    assert browser.evaluate("document.querySelectorAll('.views svg').length") == 3
    browser.evaluate("document.querySelector('[data-part=play]').click()")
    browser.wait_for("document.querySelector('.motion').player.time > 0.05")
    assert browser.complaints() == []


def test_it_reads_well_on_a_phone_and_a_laptop_light_and_dark(browser, page):
    assert measure_layout(browser, page) == []


@pytest.mark.campaign
@pytest.mark.parametrize("name", SHIPPED)
def test_reports_of_the_shipped_problems_read_well(browser, name, tmp_path):
    page = write(design(PROBLEMS / f"{name}.yaml"), tmp_path / "report.html")
    assert measure_layout(browser, page) == []


@pytest.mark.campaign
@pytest.mark.parametrize(
    ("count", "more"),
    [(60, {}), (60, AXES), (300, {}), (1000, {}), (300, {"nodes": {"dwell": "30 s"}})],
    ids=["59", "59 with dwells, axes, torque", "299", "999", "299 with dwells"],
)
def test_reports_of_many_legs_read_well(browser, count, more, tmp_path):
    page = write(design_set(count, **more), tmp_path / "report.html")
    assert measure_layout(browser, page) == []
