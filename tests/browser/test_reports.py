"""Whole reports in the browser: of arcs and of Bézier curves."""

import pytest

from tests.browser.layout import WIDTHS
from tests.curves import PLACES, TURNS, curve, make
from timelaw.report import render_report
from timelaw.report.curves.page import render_curve_report

DIGEST = "sha256:0"


@pytest.fixture(scope="module", params=["arcs", "curves"])
def page(request, paper, tmp_path_factory):
    files = (
        render_report(paper, DIGEST)
        if request.param == "arcs"
        else render_curve_report(make([curve(TURNS[:2], PLACES[:2])]), DIGEST)
    )
    path = tmp_path_factory.mktemp("report") / "report.html"
    path.write_text(files["report.html"], encoding="utf-8")
    return path


@pytest.mark.parametrize("width", WIDTHS)
def test_the_body_moves_in_it_and_nothing_is_complained_of(browser, page, width):
    browser.open(page, width)
    assert browser.evaluate("document.querySelectorAll('.motion.ready').length") == 1
    assert browser.evaluate("document.querySelectorAll('.views svg').length") == 3
    browser.evaluate("document.querySelector('[data-part=play]').click()")
    browser.wait_for("document.querySelector('.motion').player.time > 0.05")
    assert browser.complaints() == []
