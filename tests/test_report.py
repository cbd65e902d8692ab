"""The report: self-contained, the same every time, and saying what the certificates say."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from tests.cases import reference
from timelaw.report import list_law_rows, render_report
from timelaw.report.summary import list_run_rows

DIGEST = "sha256:0"


@pytest.fixture(scope="module")
def files(paper):
    return render_report(paper, DIGEST)


class Balance(HTMLParser):
    """Opening and closing tags in turn."""

    VOID = frozenset({"meta", "br", "path", "use", "rect", "link"})

    def __init__(self):
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs):  # noqa: ARG002
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag


def test_the_page_is_whole_and_self_contained(files):
    page = files["report.html"]
    parser = Balance()
    parser.feed(page)
    assert parser.open == []
    assert not re.search(r"<(script|link|img|iframe)", page)
    assert not re.search(r'(href|src)="https?:', page)
    assert page.count("<svg") == 2


def test_figures_are_vector_graphics(files):
    for name in ("rates.svg", "easings.svg"):
        root = ET.fromstring(files[name])
        assert root.tag.endswith("svg")
        assert "<image" not in files[name]


def test_two_runs_write_the_same_texts(paper, files):
    assert render_report(paper, DIGEST) == files


def test_the_verdict_comes_first_and_the_numbers_are_the_laws(files):
    page = files["report.html"]
    verdict = page.index("Certified.")
    assert verdict < page.index("Laws side by side")
    text = re.sub(r"\s+", " ", page[verdict : verdict + 600])
    assert (
        "28.8289 s: 30.1 % less than the paper's quintic, 4.45 % above the physical limit of 27.6 s" in text
    )
    for number in ("41.2500", "27.6000", "29.7000"):
        assert number in page
    assert DIGEST in page


def test_a_law_that_breaks_a_limit_is_called_so(paper):
    law = replace(paper.optimised.law, limits={**paper.optimised.law.limits, "jerk": 1.0})
    from timelaw.certificate import certify

    broken = replace(paper, optimised=replace(paper.optimised, law=law, certificate=certify(law)))
    page = render_report(broken, DIGEST)["report.html"]
    assert "Not certified." in page
    assert "over the limit of 1 rad/s³" in page


def test_rows(paper):
    rows = {row.name: row for row in list_law_rows(paper)}
    assert rows["quintic"].to_quintic == pytest.approx(1)
    assert rows["double-S"].to_limit == pytest.approx(1)
    assert rows["optimised"].to_limit == pytest.approx(1.0445, abs=1e-3)
    assert all(row.holds for row in rows.values())
    assert [run.count for run in list_run_rows(paper)] == [5, 3]


def test_names_from_files_are_escaped(paper):
    segment = replace(paper.optimised.law.segments[0], origin="<script>alert(1)</script>")
    law = replace(paper.optimised.law, segments=(segment, *paper.optimised.law.segments[1:]))
    from timelaw.certificate import certify

    changed = replace(paper, optimised=replace(paper.optimised, law=law, certificate=certify(law)))
    assert "<script>" not in render_report(changed, DIGEST)["report.html"]


def test_many_legs_show_the_first_of_them():
    page = render_report(reference("imu-calibration-120-cell"), DIGEST)["report.html"]
    assert len(page) < 3_000_000
    assert "C2" in page
