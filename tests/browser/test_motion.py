"""The motion in the page: evaluated there as in Python, turned, played, and read on a phone."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from tests.browser.layout import WIDTHS, measure_layout
from tests.browser.pages import make_law, write_page
from timelaw.certificate import certify
from timelaw.law_file import from_document, read_law
from timelaw.limits.body import WHEELS, RigidBody
from timelaw.numerics.bernstein import elevate

ROOT = Path(__file__).parents[2]
UNEVEN = "pieces of more than one degree"
LAWS = {
    "arcs": ROOT / "results/paper-24-cell/law.json",
    "through": ROOT / "results/paper-24-cell-through/law.json",
    UNEVEN: ROOT / "tests/fuzz/corpus/law/spline.json",
    **{
        name: ROOT / f"tests/fuzz/corpus/law/{name}.json"
        for name in ("arcs-and-curves", "curves", "moving", "points", "spline")
    },
}
CLOSE = 1e-9  # of the largest value of that rate
ASIDE = 1e-8  # s
PLAYER = "document.querySelector('.motion').player"
STATES = """(times) => times.map((t) => {
  const { law } = %s;
  law.moveTo(t);
  return [[...law.q], ...law.rates.slice(1).map((r) => [...r]), ...law.places.map((p) => [...p])];
})"""


@pytest.fixture(scope="module", params=LAWS)
def shown(request, browser, tmp_path_factory):
    law, document = read_law(LAWS[request.param])
    if request.param == UNEVEN:
        for segment in document["segments"]:
            piece = segment["pieces"][len(segment["pieces"]) // 2]
            piece["bernstein"] = elevate(piece["bernstein"], len(piece["bernstein"]) + 1).tolist()
        law = from_document(document)
    page = write_page(law, tmp_path_factory.mktemp("pages") / f"{request.param}.html")
    browser.open(page, WIDTHS[1])
    return law, document, page


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """The paper's motion, as it stands when the page has been opened."""
    law, document = read_law(LAWS["arcs"])
    page = write_page(law, tmp_path_factory.mktemp("pages") / "paper.html")

    def again(**how):
        browser.open(page, WIDTHS[1], **how)
        return law, document

    return again


def read_time(browser):
    return browser.evaluate(f"{PLAYER}.time")


def differ(p, q):
    """How far apart two orientations are, as numbers of theirs."""
    return min(np.max(np.abs(np.subtract(p, q))), np.max(np.abs(np.add(p, q))))


def test_the_script_evaluates_as_python_does(browser, shown):
    law, _, _ = shown
    rng = np.random.default_rng(5)
    times = np.concatenate([rng.uniform(0, law.duration, 60), law.times])
    states = browser.evaluate(f"({STATES % PLAYER})({times.tolist()})")
    found = [np.array([state[k] for state in states]) for k in range(8)]
    assert np.max(np.abs(found[0] - law(times))) < CLOSE
    for order in range(1, 5):
        expected = law(times, order)
        assert np.max(np.abs(found[order] - expected)) <= CLOSE * max(np.max(np.abs(expected)), 1e-300)
    if law.travels:
        for order in range(3):
            expected = law.place(times, order)
            assert np.max(np.abs(found[5 + order] - expected)) <= CLOSE * np.max(np.abs(expected))
    assert browser.complaints() == []


def test_the_slider_at_a_nodes_time_gives_the_nodes_orientation(browser, shown):
    law, document, _ = shown
    for time, segment in zip(law.times[:-1], document["segments"], strict=True):
        moved = browser.evaluate(
            f"(() => {{ const s = document.querySelector('[data-part=time]'); s.value = {float(time)};"
            f" s.dispatchEvent(new Event('input')); return [...{PLAYER}.law.q]; }})()"
        )
        assert differ(moved, segment.get("start", segment.get("orientation"))) < CLOSE


def test_it_plays_and_pauses(browser, opened):
    law, _ = opened()
    button = "document.querySelector('[data-part=play]')"
    browser.evaluate(f"{button}.click()")
    browser.wait_for(f"{PLAYER}.time > 0.1")
    assert browser.evaluate(f"{button}.textContent") == "Pause"
    browser.evaluate(f"{button}.click()")
    here = read_time(browser)
    browser.settle()
    assert read_time(browser) == here
    assert float(browser.evaluate("document.querySelector('[data-part=time]').value")) == pytest.approx(here)
    browser.evaluate(f"{PLAYER}.seek({law.duration} - 0.05)")
    browser.evaluate(f"{button}.click()")
    browser.wait_for(f"!{PLAYER}.playing")
    assert read_time(browser) == law.duration


@pytest.mark.parametrize("calm", [True, False])
def test_nothing_moves_unasked(browser, opened, calm):
    opened(calm=calm)
    browser.settle()
    assert read_time(browser) == 0


def test_the_keyboard_turns_plays_and_goes_from_node_to_node(browser, opened):
    law, _ = opened()
    view = f"[{PLAYER}.canvas.azimuth, {PLAYER}.canvas.elevation]"
    browser.evaluate("document.querySelector('[data-part=canvas]').focus()")
    before = browser.evaluate(view)
    browser.press("ArrowLeft")
    browser.press("ArrowUp")
    assert np.all(np.subtract(browser.evaluate(view), before) > 0.05)
    for time in law.times[1:4]:
        browser.press(".")
        assert read_time(browser) == time
    browser.press(",")
    assert read_time(browser) == law.times[2]
    browser.press(" ", " ")
    browser.wait_for(f"{PLAYER}.time > {law.times[2]} + 0.05")
    browser.press(" ", " ")
    assert not browser.evaluate(f"{PLAYER}.playing")
    assert browser.complaints() == []


def test_the_mouse_turns_the_view_and_the_picture_changes(browser, opened):
    opened()
    picture = "document.querySelector('[data-part=canvas]').toDataURL()"
    x, y, wide = browser.evaluate(
        "(() => { const r = document.querySelector('[data-part=canvas]').getBoundingClientRect();"
        " return [r.x, r.y, r.width]; })()"
    )
    pictures = [browser.evaluate(picture)]
    browser.drag((x + wide / 2, y + wide / 2), (x + wide / 2 + 40, y + wide / 2 + 10))
    browser.settle()
    assert browser.evaluate(f"{PLAYER}.canvas.azimuth") == pytest.approx(
        np.radians(35) - 40 / (0.43 * wide), rel=0.02
    )
    pictures.append(browser.evaluate(picture))
    browser.evaluate(f"{PLAYER}.seek(3.3)")
    pictures.append(browser.evaluate(picture))
    assert len(set(pictures)) == 3


def test_a_finger_turns_the_view(browser, tmp_path):
    browser.open(write_page(read_law(LAWS["arcs"])[0], tmp_path / "page.html"), WIDTHS[0])
    before = browser.evaluate(f"{PLAYER}.canvas.azimuth")
    for kind, points in (
        ("touchStart", [{"x": 150, "y": 150}]),
        ("touchMove", [{"x": 190, "y": 150}]),
        ("touchEnd", []),
    ):
        browser.send("Input.dispatchTouchEvent", type=kind, touchPoints=points)
    assert browser.evaluate(f"{PLAYER}.canvas.azimuth") < before - 0.1
    assert browser.evaluate("scrollY") == 0


def test_the_bars_are_the_certificates_numbers(browser, shown):
    """At the instant of a proved peak the bar of that limit shows the peak, on one side of it if rates jump."""
    law, _, _ = shown
    checks = certify(law).limits
    limits = browser.evaluate(f"{PLAYER}.law.limits")
    labels = [c["name"] if c["axis"] is None else f"{c['name']} {'xyz'[c['axis']]}" for c in limits]
    assert set(labels) == {check.limit.split(" on ")[0] for check in checks}
    for check in checks:
        k = labels.index(check.limit.split(" on ")[0])
        sides = [max(check.time - ASIDE, 0.0), check.time, min(check.time + ASIDE, law.duration)]
        values, bounds = np.transpose(
            browser.evaluate(
                f"{sides}.map((t) => {{ const {{ law }} = {PLAYER}; law.moveTo(t); return law.measure(law.limits[{k}]); }})"
            )
        )
        assert np.min(bounds) <= check.bound * (1 + CLOSE)
        if check.note:  # more is demanded than the limit
            assert np.max(values) <= check.upper
        else:
            assert np.max(values) == pytest.approx(check.peak, rel=1e-5)


def test_what_is_written_beside_the_picture(browser, opened):
    """Numbers to four digits of their bounds or greatest values; rounding is zero, and has no sign."""
    law, _ = opened()
    browser.evaluate(f"{PLAYER}.seek({law.duration / 3})")
    read = "[...document.querySelectorAll('{}')].map((e) => e.textContent)"
    omega = np.degrees(law(law.duration / 3, 1))
    for k, (check, text) in enumerate(
        zip(certify(law).limits, browser.evaluate(read.format("[data-bar=value]")), strict=True)
    ):
        value, bound = (float(part.split(" ")[0]) for part in text.split(" of "))
        size = np.degrees(np.linalg.norm(law(law.duration / 3, k + 1)))
        assert bound == pytest.approx(np.degrees(check.bound), rel=1e-3)
        assert value == pytest.approx(size, abs=1e-3 * bound)
    (written,) = browser.evaluate(read.format("[data-part=omega]"))
    found = [float(part.replace("−", "-")) for part in written.split()]
    np.testing.assert_allclose(found, omega, atol=0.01)
    browser.evaluate(f"{PLAYER}.seek(0)")
    assert browser.evaluate(read.format("[data-part=omega]")) == ["0.00  0.00  0.00"]


@pytest.mark.parametrize("actuator", ["external", WHEELS])
def test_torque_and_momentum_are_those_of_the_body(browser, tmp_path, actuator):
    inertia, momentum = np.array([[3.0, 0.2, 0], [0.2, 4, 0.1], [0, 0.1, 5]]), np.array([0.3, -0.2, 0.5])
    momentum = momentum if actuator == WHEELS else np.zeros(3)
    law, _ = read_law(LAWS["through"])
    limits = {"torque": (30.0, 40.0, 50.0), "momentum": 20.0}
    law = replace(law, body=RigidBody(inertia, actuator, momentum), limits=limits)
    browser.open(write_page(law, tmp_path / "torque.html"), WIDTHS[1])
    total = law.rotation(0.0) @ momentum
    for t in np.linspace(0.1, law.duration - 0.1, 7).tolist():
        omega, alpha, seen = law(t, 1), law(t, 2), law.rotation(t).T @ total
        drift = np.cross(omega, seen if actuator == WHEELS else inertia @ omega)
        expected = [*np.abs(inertia @ alpha + drift), np.linalg.norm(seen - inertia @ omega)]
        measured = browser.evaluate(
            f"(() => {{ const {{ law }} = {PLAYER}; law.moveTo({t}); return law.limits.map((l) => law.measure(l)[0]); }})()"
        )
        assert measured == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_the_angle_to_the_arcs_is_the_certificates(browser, tmp_path):
    law, _ = read_law(LAWS["through"])
    bound = {"deviation": 0.4}
    law = replace(law, segments=tuple(replace(s, limits=bound) for s in law.segments))
    browser.open(write_page(law, tmp_path / "deviation.html"), WIDTHS[1])
    peaks = [peak for peak in certify(law).peaks if peak.label == "deviation"]
    assert len(peaks) == len(law.segments)
    for peak in peaks:
        measured = browser.evaluate(
            f"(() => {{ const {{ law }} = {PLAYER}; law.moveTo({peak.time}); return law.measure(law.limits.at(-1)); }})()"
        )
        assert measured == pytest.approx([peak.peak, 0.4], rel=1e-6)


def test_long_laws_find_their_segment(browser, tmp_path):
    law = make_law(999)
    page = write_page(law, tmp_path / "long.html")
    assert page.stat().st_size < 1_000_000
    browser.open(page, WIDTHS[1])
    times = [float(t) for a, b in pairwise(law.times[::40]) for t in (a, (a + b) / 2)]
    states = browser.evaluate(f"({STATES % PLAYER})({times})")
    for t, state in zip(times, states, strict=True):
        assert differ(state[0], law(t)) < CLOSE
    assert browser.complaints() == []


@pytest.mark.parametrize("name", ["arcs", "points"])
def test_the_page_reads_well_on_phone_and_laptop_in_light_and_dark(browser, tmp_path, name):
    page = write_page(read_law(LAWS[name])[0], tmp_path / "page.html")
    assert measure_layout(browser, page) == []


def test_what_reads_badly_is_found(browser, tmp_path):
    page = tmp_path / "bad.html"
    page.write_text(
        '<meta name="viewport" content="width=device-width, initial-scale=1"><div style="width: 2000px">wide</div>'
        '<svg viewBox="0 0 1000 100" width="300"><text x="5" y="50" font-size="20">small</text>'
        '<text x="10" y="55" font-size="20">upon</text><text x="980" y="50" font-size="40">beyond</text></svg>'
    )
    findings = "\n".join(measure_layout(browser, page))
    for part in (
        "scrolls sideways",
        '6.0 px: text "small"',
        "cut by",
        'overlap: text "small" and text "upon"',
    ):
        assert part in findings
