"""The page of the report: whole, self-contained, the same every time, readable by all."""

import re
import xml.etree.ElementTree as ET
from html.parser import HTMLParser

import pytest

from timelaw.report import render_report
from timelaw.report.figures.style import THEME

DIGEST = "sha256:0"


@pytest.fixture(scope="module")
def files(paper):
    return render_report(paper, DIGEST)


class Balance(HTMLParser):
    """Opening and closing tags in turn."""

    VOID = frozenset({"meta", "br", "path", "use", "rect", "link", "input"})

    def __init__(self):
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs):  # noqa: ARG002
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open.pop() == tag


def figures_of(page):
    """The pictures that stand in two sizes."""
    return re.findall(r'<div class="(?:wide|narrow)">\s*(<svg.*?</svg>)', page, flags=re.S)


def test_the_page_is_whole_and_self_contained(files):
    page = files["report.html"]
    parser = Balance()
    parser.feed(page)
    assert parser.open == []
    assert not re.search(r"<(link|img|iframe)|<script[^>]* src|@import|fetch\(|XMLHttpRequest", page)
    assert not re.search(r'(href|src)="https?:|url\((?!#)', page)
    assert len(figures_of(page)) == 2 * 4  # for screens and paper, and for phones


def test_figures_are_vector_graphics(files):
    for name in ("laws.svg", "rates.svg", "limits.svg", "easings.svg"):
        root = ET.fromstring(files[name])
        assert root.tag.endswith("svg")
        assert "<image" not in files[name]


def test_two_runs_write_the_same_texts(paper, files):
    assert render_report(paper, DIGEST) == files


def test_the_contents_lead_to_every_section(files):
    page = files["report.html"]
    links = re.findall(r'<a href="#([^"]+)">', page)
    assert links == re.findall(r'<h2 id="([^"]+)">', page)
    assert len(links) == len(set(links)) >= 9


def test_no_two_elements_have_one_identifier_and_every_reference_has_its_element(files):
    page = files["report.html"]
    known = re.findall(r' id="([^"]+)"', page)
    assert len(known) == len(set(known))
    asked = re.findall(r'(?:href="#|url\(#)([^")]+)', page)
    asked += [key for keys in re.findall(r'aria-labelledby="([^"]+)"', page) for key in keys.split()]
    assert set(asked) <= set(known)


def test_every_picture_has_a_title_and_says_what_it_shows(files):
    for svg in figures_of(files["report.html"]):
        assert re.search(r'role="img".*<title id=.*</title>\s*<desc id=.*</desc>', svg, flags=re.S)
    told = re.search(r"<desc[^>]*>(.*?)</desc>", files["rates.svg"], flags=re.S)[1]
    assert "angular acceleration [deg/s²] at most 112.56 of 120" in told
    assert len(re.findall(r"<figure id=.*?<figcaption>\s*\w", files["report.html"], flags=re.S)) == 4


def test_colours_are_the_pages_and_every_one_has_a_dark_twin(files):
    page = files["report.html"]
    style = re.search(r"<style>(.*?)</style>", page, flags=re.S)[1]
    light, dark = style.split("prefers-color-scheme: dark", 1)
    names = {n for text in (style, *figures_of(page)) for n in re.findall(r"var\(--([\w-]+)\)", text)}
    assert names <= set(re.findall(r"--([\w-]+):", light)) & set(re.findall(r"--([\w-]+):", dark))
    for svg in figures_of(page):
        assert not re.findall(r"#[0-9a-f]{6}", svg)
    assert set(THEME.values()) <= set(re.findall(r"--([\w-]+):", light))
