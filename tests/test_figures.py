"""Pictures: their numbers are the certificate's, nothing proved lies outside them, no two texts touch."""

from dataclasses import replace
from itertools import combinations
from types import SimpleNamespace

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from tests.cases import PROBLEMS, reference
from timelaw.certificate import certify
from timelaw.law_file import read_law
from timelaw.motion.dwell import Dwell
from timelaw.pipeline import Certified
from timelaw.report.figures.binding import measure_use
from timelaw.report.figures.channels import list_channels, trace_channel
from timelaw.report.figures.drawn import Scene
from timelaw.report.figures.easings import draw_easings
from timelaw.report.figures.overview import draw_overview
from timelaw.report.figures.rates import draw_rates
from timelaw.report.figures.registry import BINDING, FIGURES, OVERVIEW, RATES
from timelaw.report.figures.style import NARROW, WIDE, fit_text, measure_text, render_svg, use_style
from timelaw.report.figures.time_scale import TimeScale, choose_labels
from timelaw.report.figures.window import PART, cut_alike, is_long

RESULTS = PROBLEMS.parent / "results"
PHONE, LEAST = 390 - 2 * 0.9 * 16, 9.0  # pixels: what a phone leaves for a picture, and its smallest letters


def from_file(name):
    """A law of the committed results, beside nothing."""
    law, _ = read_law(RESULTS / name / "law.json")
    return SimpleNamespace(optimised=Certified("optimised", law, certify(law)), baselines=())


def renamed(legs=11):
    """The paper's law with names that are long, of markup, of mathematics, and of letters no font here has."""
    found = from_file("paper-24-cell")
    names = [
        "$\\alpha_1$ a very long name of a station in the north hall",
        "<b>&amp;",
        "名前三つ目の姿勢",
        "a_b^c$x",
    ]
    law = found.optimised.law
    labels = [names[k % 4] + str(k) for k in range(12)]
    segments = tuple(
        replace(s, origin=labels[k], target=labels[k + 1]) for k, s in enumerate(law.segments[:legs])
    )
    law = replace(law, segments=segments)
    return SimpleNamespace(optimised=Certified("optimised", law, certify(law)), baselines=())


DESIGNS = {
    "odd names": renamed,
    "arcs, norms": lambda: from_file("paper-24-cell"),
    "rational segments": lambda: from_file("paper-24-cell-through"),
    "wheels, torque by axis, dwells": lambda: reference("reaction-wheel-slew"),
    "by axis, one leg apart": lambda: reference("wrist-calibration"),
    "299 legs": lambda: reference("imu-calibration-120-cell"),
    "59 legs": lambda: reference("gimbal-600-cell"),
}


@pytest.fixture(scope="module", params=DESIGNS)
def scene(request):
    return Scene(DESIGNS[request.param]())


def test_what_is_drawn_reaches_every_proved_peak_and_not_more(scene):
    """Segment by segment and limit by limit, on the norm or on its axis with its sign."""
    traces = {c.name: trace_channel(c, scene.whole) for c in scene.channels}
    assert set(scene.law.limits) <= set(traces)
    compared = 0
    for peak in scene.optimised.certificate.peaks:
        trace = traces[peak.row.limit]
        least, most = trace.envelope()
        axis = peak.row.label.removeprefix(peak.row.limit).strip()
        if axis:
            i = "xyz".index(axis)
            drawn = max(-least[peak.index, i], most[peak.index, i])
        else:
            drawn = trace.largest_norms()[peak.index]
        scale = trace.channel.scale
        floor = 1e-9 * scale * peak.bound
        assert drawn == pytest.approx(scale * peak.peak, rel=1e-9, abs=floor)
        assert drawn <= scale * peak.upper * (1 + 1e-9) + floor
        compared += 1
    assert compared >= len(scene.law.legs)


def test_channels_are_the_laws_own_rates_torques_and_momenta():
    """Against finite products of the law's values: Euler's equation by NumPy, H at rest zero."""
    slew = reference("reaction-wheel-slew").optimised.law
    samples = Scene(reference("reaction-wheel-slew")).whole
    inside = np.flatnonzero(np.diff(samples.times, prepend=-1.0) > 0)[::37]
    omega, alpha = (slew(samples.times[inside], k) for k in (1, 2))
    found = {c.name: trace_channel(c, samples).values[inside] for c in list_channels(slew)}
    assert found["velocity"] == pytest.approx(np.degrees(omega), abs=1e-9)
    assert found["torque"] == pytest.approx(alpha @ slew.body.inertia.T, abs=1e-12)
    assert found["momentum"] == pytest.approx(-omega @ slew.body.inertia.T, abs=1e-12)


def drawn(picture, scene, canvas):
    with use_style():
        return picture(scene, canvas)


@pytest.mark.parametrize("canvas", [WIDE, NARROW], ids=["wide", "phone"])
def test_no_proved_peak_lies_outside_its_panel(scene, canvas):
    picture = draw_overview if is_long(scene.law) else draw_rates
    figure = drawn(picture, scene, canvas)
    scale = TimeScale(scene.law.segments)
    for channel, ax in zip(scene.channels, figure.axes, strict=True):
        for check in scene.optimised.certificate.limits:
            if check.limit.split(" ")[0] == channel.name:
                assert channel.scale * check.upper <= ax.get_ylim()[1]
                assert 0 <= scale(check.time) <= ax.get_xlim()[1]
                assert not channel.signed or ax.get_ylim()[0] <= -channel.scale * check.upper


@pytest.mark.parametrize("canvas", [WIDE, NARROW], ids=["wide", "phone"])
def test_no_two_texts_touch_and_none_is_cut_or_too_small(scene, canvas):
    """By Agg's own measures of the texts, which are not those the labels were chosen by."""
    pictures = [RATES, BINDING, *([OVERVIEW] if is_long(scene.law) else [])]
    if hasattr(scene.design, "route"):
        pictures += [FIGURES["laws.svg"], FIGURES["easings.svg"]]
    for picture in pictures:
        figure = drawn(picture.draw, scene, canvas)
        renderer = FigureCanvasAgg(figure).get_renderer()
        with use_style():
            figure.draw(renderer)
        texts = [t for t in figure.findobj(mpl.text.Text) if t.get_visible() and t.get_text().strip()]
        assert len(texts) > 5
        hidden = set(_list_hidden(figure))
        boxes = {t: t.get_window_extent(renderer) for t in texts if t not in hidden}
        width, height = figure.canvas.get_width_height()
        for text, box in boxes.items():
            assert box.x0 >= -0.5, text
            assert box.x1 <= width + 0.5, text
            assert box.y0 >= -0.5, text
            assert box.y1 <= height + 0.5, text
            assert text.get_fontsize() * PHONE / (NARROW.width * 72) >= LEAST
        for (one, a), (other, b) in combinations(boxes.items(), 2):
            apart = a.x1 <= b.x0 + 0.5 or b.x1 <= a.x0 + 0.5 or a.y1 <= b.y0 + 2 or b.y1 <= a.y0 + 2
            assert apart, f"{one} {other}"


def _list_hidden(figure):
    """Labels of ticks beyond the range of their axis, which are there but not drawn."""
    for ax in figure.axes:
        for axis in (ax.xaxis, ax.yaxis):
            low, high = axis.get_view_interval()
            room = 1e-9 * (high - low)
            yield from (t.label1 for t in axis.majorTicks if not low - room <= t.get_loc() <= high + room)


def test_long_motions_are_drawn_in_part_where_most_proved_peaks_lie():
    scene = Scene(reference("gimbal-600-cell"))
    assert len([s for s in scene.window if s.moves]) == PART
    inside = [
        c
        for c in scene.optimised.certificate.limits
        if scene.window[0].start_time <= c.time <= scene.window[-1].end_time
    ]
    assert inside
    for entry in scene.baselines:
        part = cut_alike(scene.law, scene.window, entry.law)
        assert [s.name for s in part] == [s.name for s in scene.window]
    assert [name for name, _ in scene.beside] == ["quintic", "double-S", "double-S, every stop"]


def test_rest_that_would_squeeze_the_moves_is_drawn_shorter():
    """Two legs of a second with an hour's rest: the legs keep their width, the rest has less than one."""
    law = read_law(RESULTS / "paper-24-cell" / "law.json")[0]
    first, second = law.segments[:2]
    rest = Dwell(first.target, first.end_time, 3600.0, first.end)
    segments = (first, rest, replace(second, start_time=first.end_time + 3600.0))
    scale = TimeScale(segments)
    ends = scale([s.start_time for s in segments] + [segments[-1].end_time])
    assert np.diff(ends)[0] == pytest.approx(first.duration)
    assert np.diff(ends)[2] == pytest.approx(second.duration)
    assert 0 < np.diff(ends)[1] < 0.7 * first.duration
    assert scale.shortened == (1,)
    short = TimeScale((first, replace(rest, duration=0.5), segments[2]))
    assert short.shortened == ()


def test_labels_are_thinned_in_order_and_the_first_stays():
    labels = [f"station-{k}" for k in range(400)]
    kept = choose_labels(labels, np.linspace(0.0, 10.0, 400), 10.0, WIDE)
    assert kept[0] == 0
    assert kept == sorted(set(kept))
    assert 5 <= len(kept) <= 14


def test_the_part_of_a_limit_that_is_used_is_the_certificates(scene):
    used = measure_use(scene.law, scene.optimised.certificate)
    for check in scene.optimised.certificate.limits:
        assert np.max(used[check.limit.split(" on ")[0]]) >= check.ratio - 1e-12
    assert all(parts.shape == (len(scene.law.segments),) for parts in used.values())


def test_a_thousand_equal_easings_are_drawn_once():
    figure = drawn(draw_easings, Scene(reference("imu-calibration-120-cell")), WIDE)
    assert len(figure.axes[0].lines) == 2  # the quintic's and that of all 299 legs


def test_a_calm_law_sets_the_scale_and_a_far_limit_is_not_drawn():
    """The paper's law under a jerk limit a thousand times above what it needs."""
    found = from_file("paper-24-cell").optimised
    law = replace(found.law, limits={**found.law.limits, "jerk": 1e4})
    scene = Scene(SimpleNamespace(optimised=replace(found, law=law, certificate=certify(law)), baselines=()))
    ax = drawn(draw_rates, scene, WIDE).axes[2]
    peak = np.degrees(found.certificate.continuity.peaks[3])
    assert peak < ax.get_ylim()[1] < 1.2 * peak
    assert "of 572958" in ax.texts[1].get_text()  # said, though not drawn


def test_names_are_text_in_the_file_and_cut_where_they_are_too_long():
    with use_style():
        text = render_svg(draw_rates(Scene(renamed(3)), WIDE), "x")
    assert "&lt;b&gt;&amp;amp;" in text
    assert "名前三つ目の姿勢" in text
    assert "…" in text
    assert fit_text("short", 100.0) == "short"
    cut = fit_text("a very long name of a station", 60.0)
    assert cut.endswith("…")
    assert measure_text(cut) <= 60.0 < measure_text(cut[:-1] + "nn")
