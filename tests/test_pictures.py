"""Pictures of a law: what they draw is the law's, they are the same every time, and bad names are refused."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tests.browser.pages import make_law
from timelaw.cli.app import run_command, timelaw
from timelaw.law_file import read_law
from timelaw.report.figures.samples import sample_motion
from timelaw.report.figures.style import AXIS_COLOURS, THEME
from timelaw.report.pictures.frames import list_visits
from timelaw.report.pictures.registry import PICTURES
from timelaw.report.pictures.render import SUFFIXES, embed_picture, render_picture
from timelaw.report.pictures.sampling import choose_step, find_last_shown, list_marks, sample_times
from timelaw.report.pictures.stereographic import refine
from timelaw.report.pictures.three_sphere import WHOLE, choose_projection, lift, list_edges, list_vertices
from timelaw.report.pictures.view import View, list_faces, size_box, split_sides

ROOT = Path(__file__).parent.parent
LAW = ROOT / "results/paper-24-cell/law.json"
HEADS = {".svg": b"<?xml", ".png": b"\x89PNG", ".pdf": b"%PDF"}


@pytest.fixture(scope="module")
def law():
    return read_law(LAW)[0]


@pytest.fixture(scope="module")
def texts(law):
    return {name: render_picture(law, name, ".svg").decode() for name in PICTURES}


def lines_of(axes, colour):
    return [line for line in axes.lines if line.get_color() == colour]


def test_pictures_are_texts_with_title_and_description_and_the_same_again(law, texts):
    for name, text in texts.items():
        root = ET.fromstring(text)
        tags = [child.tag.split("}")[1] for child in root][:2]
        assert tags == ["title", "desc"]
        assert "<text" in text
        assert "<image" not in text
        assert render_picture(law, name, ".svg").decode() == text


@pytest.mark.parametrize("suffix", HEADS)
def test_each_format_is_what_it_is_called(law, suffix):
    content = render_picture(law, "frames", suffix)
    assert set(HEADS) == set(SUFFIXES)
    assert content.startswith(HEADS[suffix])
    assert suffix == ".svg" or render_picture(law, "frames", suffix) == content


def test_traces_are_where_the_axes_point_in_the_printed_colours(law):
    """[MMB2017]: Ox1 red, Ox2 blue, Ox3 green; every point of a drawn trace is a body axis at some instant."""
    figure = PICTURES["traces"].draw(law)
    times = sample_times(law)
    turned = Rotation.from_quat(law(times), scalar_first=True)
    for axis, colour in enumerate(AXIS_COLOURS):
        expected = View().project(turned.apply(np.eye(3)[axis]))[:, :2]
        far, near = (np.column_stack(line.get_data()) for line in lines_of(figure.axes[0], colour))
        drawn = np.where(np.isnan(near), far, near)
        np.testing.assert_allclose(drawn, expected, atol=1e-12)
    red, blue, green = ([int(c[k : k + 2], 16) for k in (1, 3, 5)] for c in AXIS_COLOURS)
    assert [np.argmax(c) for c in (red, green, blue)] == [0, 1, 2]


def test_of_very_many_legs_the_first_are_drawn_and_said(law):
    rounds = 50
    segments = [
        replace(leg, start_time=leg.start_time + k * law.duration)
        for k in range(rounds)
        for leg in law.segments
    ]
    many = replace(law, segments=tuple(segments))
    last = many.legs[499].end_time
    assert find_last_shown(many) == pytest.approx(last, rel=1e-15)
    assert find_last_shown(law) == law.duration
    figures = {name: PICTURES[name].draw(many) for name in ("traces", "sphere")}
    for name, figure in figures.items():
        assert any("the first 500 of 550 legs" in text.get_text() for text in figure.axes[0].texts)
        assert "the first 500 of 550 legs" in PICTURES[name].describe(many)
        assert "the first" not in PICTURES[name].describe(law)
    times = sample_times(many)
    (drawn,) = {len(line.get_xdata()) for line in lines_of(figures["traces"].axes[0], AXIS_COLOURS[0])}
    assert drawn == np.count_nonzero(times <= find_last_shown(many)) < len(times)


def test_near_and_far_parts_are_the_whole():
    angle = np.linspace(0.1, 6.5, 50)
    path = np.column_stack([np.cos(angle), np.zeros(50), np.sin(angle)])
    near, far = split_sides(path)
    assert np.all(np.isfinite(near[:, 0]) == (path[:, 2] >= 0))
    assert np.all(np.isfinite(near[:, 0]) | np.isfinite(far[:, 0]))
    shared = np.isfinite(near[:, 0]) & np.isfinite(far[:, 0])
    assert np.sum(shared) == 2  # one point each where it goes from one side to the other


def test_marks_are_at_equal_steps_that_are_round_numbers(law):
    step, marks = list_marks(law)
    assert step == 1.0
    np.testing.assert_array_equal(marks, np.arange(29))
    for duration in 10.0 ** np.linspace(-6, 6, 37):
        step = choose_step(duration)
        assert 16 <= duration / step <= 40 * (1 + 1e-9)
        assert f"{step:.0e}"[0] in "125"


def test_a_body_stands_at_each_node_once(law):
    labels = [label for label, _ in list_visits(law)]
    assert labels == ["1", "12", "11", "3", "8", "10", "2", "7", "9", "6", "5", "4"]
    assert sum(text.get_text() in labels for text in PICTURES["frames"].draw(law).axes[0].texts) == 12


def test_the_faces_of_a_box_that_are_seen():
    """A face is seen where its normal points to who looks; their areas cover the box's outline."""
    view, half = View(20, 35), size_box((1.0, 1.5, 2.0))
    for q in Rotation.random(20, rng=np.random.default_rng(2)):
        faces = list_faces(q.as_matrix(), half, view)
        seen = 0.0
        for face in faces:
            a, b, c, _ = view.project(face.corners)[:, :2]
            seen += abs(np.cross(np.append(b - a, 0), np.append(c - b, 0))[2])
        normals = np.abs(view.project(q.as_matrix().T)[:, 2])
        areas = 4 * np.prod(half) / half
        assert seen == pytest.approx(float(normals @ areas), rel=1e-12)
        assert 1 <= len(faces) <= 3


def test_the_lattices_edges_are_those_of_the_24_cell(law):
    vertices = list_vertices(law)
    edges = list_edges(vertices)
    assert (len(vertices), len(edges)) == (24, 96)
    assert np.all(np.bincount(edges.ravel()) == 8)


def test_the_projection_is_stereographic(law):
    """Undone by its inverse: p = (2 x + (1 - |x|²) c)/(1 + |x|²); and the pole is far from all that is drawn."""
    points = np.concatenate([list_vertices(law), lift(law(sample_times(law)))])
    projection = choose_projection(list_vertices(law), points)
    x = projection(points)
    square = np.sum(x**2, axis=1)[:, None]
    back = (2 * x @ projection.basis + (1 - square) * projection.centre) / (1 + square)
    np.testing.assert_allclose(back, points, atol=1e-12)
    assert np.max(np.linalg.norm(x, axis=1)) < 4


def test_of_many_orientations_each_is_in_the_ball_once():
    """The half about the first: projected, q and -q are the same point within radius one, and paths are cut there."""
    law = make_law(20)
    vertices = list_vertices(law)
    assert len(vertices) > WHOLE
    projection = choose_projection(vertices, vertices)
    path = lift(law(sample_times(law)))
    np.testing.assert_allclose(projection(path), projection(-path), atol=1e-12)
    np.testing.assert_allclose(projection(law(0.0)), 0, atol=1e-12)
    assert np.max(np.linalg.norm(projection(path), axis=1)) <= 1 + 1e-12
    drawn = projection.trace(path)
    whole = np.isfinite(drawn[:, 0])
    assert 0 < np.sum(~whole) < 40
    steps = np.linalg.norm(np.diff(drawn, axis=0), axis=1)
    assert np.nanmax(steps) < 0.3


def test_the_route_keeps_its_sign_from_point_to_point(law):
    path = lift(
        law(sample_times(law)) * np.random.default_rng(1).choice([-1, 1], (len(sample_times(law)), 1))
    )
    assert np.all(np.sum(path[1:] * path[:-1], axis=1) > 0)


def test_more_points_are_put_where_the_route_runs_far_out(law):
    times = sample_times(law)[::10]
    points = choose_projection(list_vertices(law), lift(law(times)))(lift(law(times)))
    finer = refine(times, points)
    assert np.all(np.isin(times, finer))
    assert np.all(np.diff(finer) > 0)
    longest = np.argmax(np.linalg.norm(np.diff(points, axis=0), axis=1))
    assert np.sum((finer > times[longest]) & (finer < times[longest + 1])) > 3


def test_rates_keep_both_sides_of_a_jump(law):
    samples = sample_motion(law, law.segments)
    times, values = samples.times, np.stack(samples.rates[3], axis=-1)
    node = law.times[1]
    at = np.flatnonzero(np.isclose(times, node, rtol=0, atol=1e-12))
    np.testing.assert_allclose(values[at[0]], law(node, 3, side="left"), rtol=1e-9)
    np.testing.assert_allclose(values[at[-1]], law(node, 3), rtol=1e-9)


def test_what_is_embedded_takes_the_pages_colours_and_leaves_no_identifier(law):
    text = embed_picture(law, "traces")
    assert re.match(r'<svg [^>]*role="img"', text)
    assert "var(--axis-x)" in text
    assert not re.search(rf"(?:{'|'.join(THEME)})\b", text)
    assert not re.search(r' id="(?:figure|axes|text|line2d|patch)', text)
    assert ET.fromstring(text.replace("xlink:href", "href")) is not None


def test_pictures_of_long_laws_and_odd_names_stay_small_and_whole():
    law = make_law(300)
    sizes = {name: len(embed_picture(law, name)) for name in ("traces", "frames", "sphere")}
    assert sum(sizes.values()) < 900_000
    odd = replace(law.segments[0], origin="<b>$x^2$" + "long" * 99)
    text = render_picture(replace(law, segments=(odd, *law.segments[1:])), "frames", ".svg").decode()
    assert "&lt;b&gt;$x^2$" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ["--what", "traces", "-o", "out.gif"],
            '-o "out.gif": a name that ends in .svg, .png, .pdf is needed',
        ),
        (["--what", "colour", "-o", "out.svg"], '--what "colour": allowed: traces, frames, sphere, rates'),
        ([], "Missing option '-o' / '--output'"),
    ],
)
def test_what_cannot_be_drawn_is_refused(arguments, message, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_command(["plot", str(LAW), *arguments]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("command", [["plot", "-o", "out.svg"], ["animate", "-o", "out.gif"]])
def test_a_law_without_an_orientation_somewhere_is_refused(command, capsys, tmp_path, monkeypatch):
    """Q runs through zero in the middle of the third leg."""
    monkeypatch.chdir(tmp_path)
    document = json.loads((ROOT / "results/paper-24-cell-through/law.json").read_text())
    piece = document["segments"][2]["pieces"][0]
    piece["control"] = [[0.0] * 4 for _ in piece["control"]]
    Path("law.json").write_text(json.dumps(document))
    assert run_command([command[0], "law.json", *command[1:]]) == 2
    time = document["segments"][2]["start_time"]
    told = f"nothing can be drawn at t = {time:.6g} s; timelaw verify says what is wrong"
    assert told in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["law.json"]


def test_labels_of_other_scripts_are_drawn_without_a_word(law):
    odd = replace(law.segments[0], origin="目标 😀 \u202e")
    changed = replace(law, segments=(odd, *law.segments[1:]))
    assert "目标" in render_picture(changed, "frames", ".svg").decode()
    for suffix in (".png", ".pdf"):
        assert render_picture(changed, "frames", suffix)


def test_the_command_writes_the_picture_and_says_so(capsys, tmp_path):
    file = tmp_path / "new" / "out.SVG"
    assert run_command(["plot", str(LAW), "--what", "frames", "-o", str(file), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["files"] == [str(file)]
    assert file.read_bytes().startswith(b"<?xml")


def test_the_help_names_the_pictures_that_there_are():
    told = next(option.help for option in timelaw.commands["plot"].params if option.name == "what")
    assert re.findall(r"\w+", told.split("[")[0].replace(" or ", " ")) == list(PICTURES)
