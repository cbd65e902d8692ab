"""A test for each numbered row of the source documents, each with an oracle of its own."""

import json
import struct
from itertools import pairwise
from math import comb
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation, Slerp

from tests.cases import PROBLEMS
from tests.laws import angles_between, law_of
from timelaw import quaternion
from timelaw.bezier.curve import Curve
from timelaw.bezier.joints import find_joints
from timelaw.bezier.read import read_curves
from timelaw.certificate import certify
from timelaw.export.exporter import Options
from timelaw.export.formula import evaluate_formula
from timelaw.export.registry import EXPORTERS
from timelaw.least_time.double_s import double_s_time
from timelaw.orientations.lattices import make_lattice
from timelaw.pipeline import lay_out
from timelaw.problem import load_problem
from timelaw.report.figures.box import draw_box, trace_corners
from timelaw.report.figures.sphere import AXES, draw_traces
from timelaw.report.figures.style import WIDE
from timelaw.report.pictures.render import draw_picture

H = 0.5
TWELVE = [
    (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (H, H, H, H), (H, -H, H, H), (H, H, -H, H),
    (H, H, H, -H), (H, -H, -H, H), (H, H, -H, -H), (H, -H, H, -H), (H, -H, -H, -H),
]  # fmt: skip
TOUR = [1, 12, 11, 3, 8, 10, 2, 7, 9, 6, 5, 4]


@pytest.fixture(scope="module")
def layout():
    return lay_out(PROBLEMS / "paper-24-cell.yaml")


@pytest.fixture(scope="module")
def curves():
    return read_curves(load_problem(PROBLEMS / "hajsen-zmazek.yaml")[0])


POLYTOPES = {
    "16-cell": (4, 6),
    "tesseract": (8, 4),
    "24-cell": (12, 8),
    "600-cell": (60, 12),
    "120-cell": (300, 4),
}


@pytest.mark.parametrize("name", POLYTOPES)
def test_mmb2017_1_uniform_orientations(name):
    """Half of the vertices of a regular polytope: all on its hull, each with as many nearest neighbours."""
    count, neighbours = POLYTOPES[name]
    q = make_lattice(name)
    whole = np.concatenate([q, -q])
    assert len(q) == count
    assert len(np.unique(np.round(whole, 9), axis=0)) == 2 * count  # no antipodal pair was kept
    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1, atol=1e-15)
    if count <= 60:
        assert len(ConvexHull(whole).vertices) == 2 * count
    cosines = np.round(whole @ whole.T - 2 * np.eye(2 * count), 9)
    assert set(np.sum(cosines == np.max(cosines), axis=1)) == {neighbours}


def test_mmb2017_2_the_twelve_orientations_have_the_papers_numbers():
    np.testing.assert_array_equal(make_lattice("24-cell"), TWELVE)


def test_mmb2017_3_table_1_has_no_absolute_value_and_so3_has():
    q = np.array(make_lattice("24-cell"))
    pairs = np.arccos((q @ q.T).clip(-1, 1))[np.triu_indices(12, 1)]
    values, counts = np.unique(np.round(pairs * 6 / np.pi), return_counts=True)
    assert dict(zip(values.tolist(), counts.tolist(), strict=True)) == {2.0: 32, 3.0: 18, 4.0: 16}
    assert len(pairs) + 12 == 78
    near = np.isclose(np.abs(q @ q.T), 0.5)
    assert np.sum(near) // 2 == 48
    assert set(np.sum(near, axis=1)) == {8}


def test_mmb2017_4_the_tour_is_shortest_and_goes_straight_on_at_three_nodes(layout):
    assert [i + 1 for i in layout.tour.order] == TOUR
    assert layout.tour.is_shortest
    turns = Rotation.from_quat(np.array(TWELVE, dtype=float)[np.array(TOUR) - 1], scalar_first=True)
    legs = (turns[:-1].inv() * turns[1:]).as_rotvec()
    np.testing.assert_allclose(np.linalg.norm(legs, axis=1), 2 * np.pi / 3)
    axes = legs / np.linalg.norm(legs, axis=1)[:, None]
    np.testing.assert_allclose(np.abs(axes), 1 / np.sqrt(3))
    corners = [round(float(np.degrees(np.arccos(np.clip(a @ b, -1, 1)))), 2) for a, b in pairwise(axes)]
    assert [TOUR[k + 1] for k, turn in enumerate(corners) if turn == 0] == [11, 8, 7]
    assert set(corners) == {0.0, 70.53, 109.47}
    for leg, axis in zip(layout.route.legs, axes, strict=True):
        np.testing.assert_allclose(leg.axis, axis, atol=1e-12)
    assert [node.label for node in layout.route.nodes[1:-1] if node.kind == "straight"] == ["11", "8", "7"]


def test_mmb2017_5_the_baseline_is_slerp_with_the_quintic(paper):
    law = next(entry.law for entry in paper.baselines if entry.name == "quintic")
    for segment in law.segments:
        tau = np.linspace(0, 1, 41)
        f = (6 * tau**5 - 15 * tau**4 + 10 * tau**3).clip(0, 1)
        arc = np.pi / 3
        slerped = np.outer(np.sin(arc * (1 - f)), segment.start) + np.outer(np.sin(arc * f), segment.end)
        np.testing.assert_allclose(segment(tau, 0, "right"), slerped / np.sin(arc), atol=1e-14)


def test_mmb2017_6_one_formula_is_the_whole_motion():
    for name in ("paper", "dwells", "spline", "through"):
        law = law_of(name)
        t = law.duration * (np.arange(1000) + 0.4321) / 1000
        np.testing.assert_allclose(evaluate_formula(law, t), law(t), atol=2e-13)
    text = EXPORTERS["formula"].write(law_of("paper"), Options())[".txt"]
    assert text.count("q(t) = ") == 1
    assert text.splitlines()[-1].count("H(t, ") == 11  # eleven legs: the printed sum has one term too many


def test_mmb2017_7_rotation_matrix_and_direction_cosines():
    law = law_of("paper")
    t = np.linspace(0, law.duration, 50)
    turns = Rotation.from_quat(law(t), scalar_first=True)
    np.testing.assert_allclose(law.rotation(t), turns.as_matrix(), atol=1e-14)
    r0 = np.array([0.3, -0.2, 0.9])
    np.testing.assert_allclose(law.rotation(t) @ r0, turns.apply(r0), atol=1e-14)
    for axis in range(3):  # the rows of Q trace the body axes
        np.testing.assert_allclose(
            law.direction_cosines(t)[:, axis], turns.apply(np.eye(3)[axis]), atol=1e-14
        )


def test_mmb2017_8_traces_of_the_body_axes_the_body_at_the_nodes_and_an_animation(layout):
    picture = draw_traces("paper", layout.route)
    red, blue, green = (colour for _, colour in AXES)  # as the printed version has them
    assert picture.count("body axis") == 3
    for colour, (high, others) in {red: (0, (1, 2)), blue: (2, (0, 1)), green: (1, (0, 2))}.items():
        parts = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
        assert all(parts[high] > parts[other] for other in others)
        assert colour in picture
    law = law_of("paper")
    (panel,) = draw_picture(law, "frames").axes
    told = [text.get_text() for text in panel.texts]
    assert [word for word in told if word in law.labels] == list(
        law.labels
    )  # figure 1: each node in its turn
    assert [word for word in told if word.endswith(" s")] == [f"{time:.4g} s" for time in law.times]
    moving = EXPORTERS["gltf"].write(law_of("paper"), Options(30.0))[".glb"]
    length = struct.unpack("<I", moving[12:16])[0]
    document = json.loads(moving[20 : 20 + length])
    times = document["accessors"][document["animations"][0]["samplers"][0]["input"]]
    assert times["max"] == [pytest.approx(law_of("paper").duration, rel=1e-7)]
    assert times["count"] > 800


def test_mmb2017_9_intervals_and_laws_on_them_are_chosen():
    """Under the same limits, which both hold, legs of unequal times are faster than the paper's equal ones."""
    law = law_of("paper")
    assert certify(law).holds
    times = np.diff(law.times)
    assert np.ptp(times) > 0.4
    w, a, j = (law.limits[key] for key in ("velocity", "acceleration", "jerk"))
    angle = 2 * np.pi / 3
    quintic = max(15 / 8 * angle / w, np.sqrt(10 / np.sqrt(3) * angle / a), np.cbrt(60 * angle / j))
    assert law.duration < 0.7 * 11 * quintic


def test_hz2019_1_a_motion_is_a_homogeneous_matrix_and_spherical_without_a_translation():
    law = law_of("points")
    t = np.linspace(0, law.duration, 40)
    matrices = np.tile(np.eye(4), (40, 1, 1))
    matrices[:, :3, :3], matrices[:, :3, 3] = law.rotation(t), law.place(t)
    corner = np.array(law.shape) / 2
    expected = Rotation.from_quat(law(t), scalar_first=True).apply(corner) + law.place(t)
    np.testing.assert_allclose((matrices @ [*corner, 1.0])[:, :3], expected, atol=1e-13)
    np.testing.assert_allclose(trace_corners(law, t)[:, -1], expected, atol=1e-13)
    assert not law_of("paper").travels


def test_hz2019_2_the_kinematic_map_and_its_inverse():
    q = np.random.default_rng(2).normal(size=(500, 4)) * 3
    turns = Rotation.from_quat(q, scalar_first=True)
    np.testing.assert_allclose(quaternion.to_matrix(q), turns.as_matrix(), atol=1e-14)
    halves = np.array([Rotation.from_rotvec(np.pi * v).as_matrix() for v in np.eye(3)])
    back = quaternion.from_matrix(np.concatenate([turns.as_matrix(), halves]))
    unit = np.concatenate([q / np.linalg.norm(q, axis=1)[:, None], np.eye(4)[1:]])
    assert np.max(angles_between(back, unit)) < 1e-14


def casteljau(points, u):
    while len(points) > 1:
        points = [(1 - u) * a + u * b for a, b in pairwise(points)]
    return points[0]


def test_hz2019_3_quaternion_curves_are_rational_motions_of_twice_their_degree(curves):
    for curve in curves:
        u = np.linspace(0, 1, 9)
        values = np.array([casteljau(list(curve.control), x) for x in u])
        assert np.max(angles_between(curve.orientation(u), values)) < 1e-14
        scaled = quaternion.to_matrix(values) * np.sum(values**2, axis=1)[:, None, None]
        differences = [(-1) ** i * comb(7, i) * scaled[i] for i in range(8)]  # of order 2n + 1 = 7
        np.testing.assert_allclose(np.sum(differences, axis=0), 0, atol=1e-12)
        assert np.max(np.abs(np.diff(scaled, n=6, axis=0))) > 1e-4


def test_hz2019_4_translations_are_divided_by_the_square_of_the_norm(curves):
    for curve in curves:
        u = np.linspace(0, 1, 9)
        w = np.array([casteljau(list(curve.points), x) for x in u])
        size = np.array([np.sum(casteljau(list(curve.control), x) ** 2) for x in u])
        np.testing.assert_allclose(curve.place(u, 0)[0], w / size[:, None], atol=1e-12)


def test_hz2019_5_the_worked_example_is_c0_only(curves):
    axis_angle = [(1, 0, 0, 0), (1, 0, 0, -90), (0, 0, 1, -90), (1, 0, -1, 135)]
    for row, control in zip(axis_angle, curves[0].control, strict=True):
        axis = np.array(row[:3]) / np.linalg.norm(row[:3])
        expected = Rotation.from_rotvec(np.radians(row[3]) * axis).as_quat(scalar_first=True)
        assert angles_between(control, expected) < 1e-12
    np.testing.assert_array_equal(curves[0].points, [(-9, -9, -9), (6, 2, 5), (-8, 6, 9), (5, 5, -5)])
    joints = find_joints(curves)
    assert [(joint.parametric, joint.geometric) for joint in joints] == [(0, 0), (0, 0)]
    assert all(joint.gap < 1e-12 and joint.distance < 1e-12 for joint in joints)
    step = 1e-6
    for joint, (before, after) in zip(joints, pairwise(curves), strict=True):
        jump = slope(after, 0.0, step) - slope(before, 1.0, -step)
        assert joint.steps[1][0] == pytest.approx(np.linalg.norm(jump), rel=1e-4)


def slope(curve, u, step):
    """The way of the origin along u by a one-sided difference."""
    ends = curve.place(np.array([u, u + step, u + 2 * step]), 0)[0]
    return (-3 * ends[0] + 4 * ends[1] - ends[2]) / (2 * step)


def test_hz2019_6_the_box_is_drawn_at_15_instants():
    figure = draw_box(SimpleNamespace(law=law_of("points")), WIDE)
    (ax,) = figure.axes
    assert [type(part).__name__ for part in ax.collections] == ["Poly3DCollection"] * 15
    assert "paths of the corners" in [line.get_label() for line in ax.lines]


def test_ir2016_turns_compose_with_the_later_one_on_the_left():
    first, later = (
        quaternion.exp_of_unit(u, angle / 2) for u, angle in (([0, 0, 1], 0.7), ([0.6, 0.8, 0], 2.1))
    )
    v = np.array([0.1, -0.4, 0.9])
    turned = Rotation.from_rotvec(2.1 * np.array([0.6, 0.8, 0])) * Rotation.from_rotvec([0, 0, 0.7])
    np.testing.assert_allclose(
        quaternion.rotate(quaternion.product(later, first), v), turned.apply(v), atol=1e-15
    )
    middle = quaternion.slerp(first, later, 0.3)
    between = Slerp([0, 1], Rotation.from_quat([first, later], scalar_first=True))(0.3)
    np.testing.assert_allclose(quaternion.to_matrix(middle), between.as_matrix(), atol=1e-14)


def test_z2025_the_double_s_takes_the_sum_of_its_quotients():
    """T = θ/v̂ + v̂/â + â/ĵ with what is reached; jerk alone: 4 ∛(θ/2j)."""
    angle, v, a, j = 2.0, 1.0, 2.0, 10.0
    assert double_s_time(angle, v, a, j) == pytest.approx(angle / v + v / a + a / j, rel=1e-14)
    assert double_s_time(angle, 1e9, 1e9, j) == pytest.approx(4 * np.cbrt(angle / (2 * j)), rel=1e-14)


def test_curves_of_any_weight_are_one_motion():
    control = np.random.default_rng(1).normal(size=(4, 4))
    u = np.linspace(0, 1, 9)
    one, other = (Curve("a", "b", control * scale).orientation(u) for scale in (1.0, 7.5))
    np.testing.assert_allclose(one, other, atol=1e-15)
