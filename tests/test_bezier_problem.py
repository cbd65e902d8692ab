"""Problem files with curves: what is wrong with them, where, and what is said of it; the command on them."""

import json

import pytest

from tests.cases import PROBLEMS
from tests.curves import LINEAR, RATES, TURNS, curve, make
from timelaw.cli.design import run
from timelaw.cli.tour import run as run_tour
from timelaw.cli.verify import run as run_verify
from timelaw.errors import InfeasibleError, InputError
from timelaw.problem import parse_problem

HEAD = "timelaw: 1\nname: c\nroute:\n  bezier:\n"
QUATERNIONS = "quaternions: [[1, 0, 0, 0], [0.8, 0.6, 0, 0]]"
ONE = f"    - {{{QUATERNIONS}}}\n"
MOVING = f"    - {{{QUATERNIONS}, points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}}\n"
TAIL = f"limits: {{{RATES}}}\n"
BOTH = f"limits: {{{RATES}, {LINEAR}}}\n"


def curves(*inner, tail=TAIL):
    return HEAD + "".join(f"    - {{{text}}}\n" for text in inner) + tail


MODEL = {
    "bare number": (curves(f"{QUATERNIONS}, points: [[0 m, 1, 0 m]]"), '5:64: route.bezier[1].points[1]: "1" has no unit; write a length like "1.5 m"'),
    "no length": (curves(f"{QUATERNIONS}, points: [[0 m, 1 s, 0 m]]"), '5:64: route.bezier[1].points[1]: "1 s" is not a length; write it like "1.5 m"'),
    "two coordinates": (curves(f"{QUATERNIONS}, points: [[0 m, 1 m]]"), "5:64: route.bezier[1].points[1]: a point has three coordinates with their units, as in [-9 m, 6 m, 0.5 m]"),
    "no points": (curves(f"{QUATERNIONS}, points: []"), "5:63: route.bezier[1].points: 0 control points; 1 to 8 are needed"),
    "one quaternion": (curves("quaternions: [[1, 0, 0, 0]]"), "5:21: route.bezier[1].quaternions: 1 control quaternions; 2 to 8 are needed"),
    "nine quaternions": (curves(f"quaternions: {[[1, 0, 0, 0]] * 9}"), "5:21: route.bezier[1].quaternions: 9 control quaternions; 2 to 8 are needed"),
    "no quaternions": (curves("points: [[0 m, 0 m, 0 m]]"), '5:7: route.bezier[1]: missing key "quaternions"'),
    "form": (curves(f"{QUATERNIONS}, as: wxzy"), '5:59: route.bezier[1].as: "wxzy"; allowed: wxyz, xyzw, rotation-vector, matrix, euler, axis-angle; did you mean "wxyz"?'),
    "unit of nothing": (curves(f"{QUATERNIONS}, unit: deg"), '5:61: route.bezier[1].unit: it belongs to "as: rotation-vector or euler or axis-angle"'),
    "angles of what": (curves("as: axis-angle, quaternions: [[1, 0, 0, 0], [1, 0, 0, 90]]"), '5:12: route.bezier[1].as: "as: axis-angle" needs "unit"'),
    "translation": (curves(f"{QUATERNIONS}, points: [[0 m, 0 m, 0 m]], translation: plane"), '5:95: route.bezier[1].translation: "plane"; allowed: divided, plain; did you mean "plain"?'),
    "translation of nothing": (curves(f"{QUATERNIONS}, translation: plain"), '5:68: route.bezier[1].translation: it says how "points" are meant, and there are none'),
    "weights": (curves(f"{QUATERNIONS}, weights: [1, 0]"), "5:64: route.bezier[1].weights: numbers from 0.001 to 1000 are needed, as in [1, 0.9, 0.9, 1]"),
    "three weights": (curves(f"{QUATERNIONS}, weights: [1, 2, 1]"), "5:64: route.bezier[1].weights: 3 weights; 2, one for each quaternion, are needed"),
    "unknown key": (curves(f"{QUATERNIONS}, point: []"), '5:55: route.bezier[1]: unknown key "point"; allowed: quaternions, points, weights, translation, as, sequence, unit; did you mean "points"?'),
    "no curves": ("timelaw: 1\nname: c\nroute: {bezier: []}\n" + TAIL, "3:17: route.bezier: 0 curves; 1 to 200 are needed"),
    "one moves": (HEAD + MOVING + ONE + TAIL, '6:7: route.bezier[2]: other curves have "points"; they are needed here too'),
    "orientations too": (curves(QUATERNIONS, tail="  orientations: {lattice: 24-cell}\n" + TAIL), "6:17: route.orientations: Bézier curves follow each other as they are given; leave it away"),
    "a tour": (curves(QUATERNIONS, tail="  tour: given\n" + TAIL), "6:9: route.tour: Bézier curves follow each other as they are given; leave it away"),
    "objective": (HEAD + ONE + TAIL + "objective: {minimise: jerk, total_time: 9 s}\n", "7:12: objective: a Bézier motion is made in least time; nothing else can be asked for"),
    "moving start": (HEAD + ONE + TAIL + "nodes: {start: {velocity: 1 deg/s}}\n", "7:16: nodes.start: a Bézier motion begins and ends at rest"),
    "node": (HEAD + ONE + TAIL + "nodes: {at: {3: {stop: true}}}\n", '7:17: nodes.at.3: no such node; the curves join "1" to "2"'),
    "a time": (HEAD + ONE + TAIL + "nodes: {at: {2: {time: 9 s}}}\n", '7:17: nodes.at.2: only "dwell" and "stop" can be asked of a joint of curves'),
    "leg": (HEAD + ONE + TAIL + "segments: {2-1: {limits: {velocity: 1 deg/s}}}\n", '7:17: segments.2-1: no such curve; they are called "1-2" to "1-2"'),
    "duration": (HEAD + ONE + TAIL + "segments: {1-2: {duration: 9 s}}\n", "7:28: segments.1-2.duration: the time of a curve cannot be given"),
    "basis": (HEAD + ONE + TAIL + "easing: {basis: double-s}\n", '7:17: easing.basis: "double-s"; on Bézier curves polynomial or spline is needed'),
    "baseline": (HEAD + ONE + TAIL + "baselines: [double-s]\n", '7:12: baselines: along curves no double-s is known; "quintic" alone can stand beside the law'),
    "linear limit": (HEAD + ONE + BOTH, '6:93: limits.linear_velocity: a limit on the linear_velocity needs curves with "points" under "bezier"; on arcs the body only turns'),
    "linear limit of arcs": ("timelaw: 1\nname: c\nroute: {orientations: {lattice: 24-cell}, tour: paper}\nlimits: {linear_acceleration: 1 m/s^2}\n", '4:31: limits.linear_acceleration: a limit on the linear_acceleration needs curves with "points" under "bezier"; on arcs the body only turns'),
    "linear limit in degrees": (HEAD + MOVING + "limits: {linear_velocity: 1 deg/s}\n", '6:27: limits.linear_velocity: "1 deg/s" is not a velocity; write it like "0.5 m/s"'),
    "shape": (HEAD + ONE + TAIL + "body: {shape: [1 m, 2 m]}\n", "7:15: body.shape: three edges of a box along the body axes are needed, as in [1 m, 1.5 m, 2 m]"),
    "shape without unit": (HEAD + ONE + TAIL + "body: {shape: [1 m, 2, 3 m]}\n", '7:15: body.shape: "2" has no unit; write a length like "1.5 m"'),
    "torque of a shape": (HEAD + ONE + "limits: {torque: 1 N*m}\nbody: {shape: [1 m, 2 m, 3 m]}\n", '6:18: limits.torque: a limit on the torque needs "body: {inertia: …}"'),
    "actuator of a shape": (HEAD + ONE + TAIL + "body: {shape: [1 m, 2 m, 3 m], actuator: wheels}\n", '7:7: body: missing key "inertia"'),
}  # fmt: skip


@pytest.mark.parametrize("case", MODEL)
def test_the_exact_message(case):
    text, message = MODEL[case]
    with pytest.raises(InputError) as error:
        parse_problem(text, "c.yaml")
    assert str(error.value) == f"c.yaml:{message}"


A = "{quaternions: [[1, 0, 0, 0], [0.8, 0.6, 0, 0]], points: [[0 m, 0 m, 0 m], [1 m, 0 m, 0 m]]}"
B = "{quaternions: [[0.8, 0.6, 0, 0], [0, 1, 0, 0]], points: [[1 m, 0.5 m, 0 m], [3 m, 0 m, 0 m]]}"
APART = "{quaternions: [[0, 1, 0, 0], [0, 0, 1, 0]], points: [[1 m, 0 m, 0 m], [3 m, 0 m, 0 m]]}"
GEOMETRY = {
    "norm": (["{quaternions: [[1, 0, 0, 0], [0.8, 0.7, 0, 0]]}"], "", "route.bezier[1].quaternions[2]: [0.8, 0.7, 0, 0] has norm 1.06301; a unit quaternion [w, x, y, z] is needed"),
    "numbers": (["{as: axis-angle, unit: deg, quaternions: [[1, 0, 0, 0], [1, 0, 90]]}"], "", "route.bezier[1].quaternions[2]: expected an axis and an angle [x, y, z, angle]"),
    "no axis": (["{as: axis-angle, unit: deg, quaternions: [[1, 0, 0, 0], [0, 0, 0, 90]]}"], "", "route.bezier[1].quaternions[2]: the axis [x, y, z] of a turn may not be zero"),
    "places apart": ([A, B], "", "route.bezier[2].points[1]: begins 0.5 m from where the curve before it ends"),
    "orientations apart": ([A, APART], "", "route.bezier[2].quaternions[1]: begins 106.26° from where the curve before it ends"),
    "through nothing": (["{quaternions: [[1, 0, 0, 0], [-1, 0, 0, 0]]}"], "", "route.bezier[1].quaternions: the quaternion of the curve nearly vanishes at u = 0.5, where it has no orientation; its control quaternions lie on opposite sides: change a sign or put one between"),
    "degree": ([curve(TURNS)], "easing: {degree: 31}", "easing.degree: 31; on curve 1–2 at most 21 is possible"),
}  # fmt: skip


@pytest.mark.parametrize("case", GEOMETRY)
def test_what_is_wrong_with_curves(case):
    given, more, message = GEOMETRY[case]
    with pytest.raises(InputError) as error:
        make(given, more=more)
    (fault,) = error.value.faults
    assert f"{fault.where}: {fault.message}" == message
    assert fault.line is not None
    assert error.value.exit_code == 2


def test_a_curve_that_nothing_limits_has_no_least_time():
    still = "{quaternions: [[1, 0, 0, 0], [0.8, 0.6, 0, 0]], points: [[1 m, 0 m, 0 m]], translation: plain}"
    with pytest.raises(
        InfeasibleError, match="nothing that is limited moves on curve 1–2: no time is the least"
    ):
        make([still], "linear_velocity: 1 m/s")


def test_a_tour_of_curves_is_refused_in_one_sentence():
    with pytest.raises(InputError, match='a Bézier motion has no tour; use "timelaw design"'):
        run_tour(str(PROBLEMS / "hajsen-zmazek.yaml"), None, table=False, as_json=False)


def test_the_worked_example_from_file_to_files(tmp_path, capsys):
    """Designed, certified, reported: C0 only, with numbers, and the box at 15 instants."""
    folder = tmp_path / "out"
    assert run(str(PROBLEMS / "hajsen-zmazek.yaml"), str(folder), as_json=True) == 0
    said = capsys.readouterr()
    assert "The given curves are joined C0 only, their path is G0; the body stops at 2, 3." in said.err
    assert (
        "Joint 2: C0 in the given parameter, G0 in its path: the axis of rotation turns by 132.7°" in said.err
    )
    found = json.loads(said.out)
    assert found["ok"]
    assert [(j["parametric"], j["geometric"], j["passed"]) for j in found["joints"]] == [(0, 0, False)] * 2
    files = {"law.json", "samples.csv", "report.html", "rates.svg", "easings.svg", "motion.svg"}
    assert files <= {path.name for path in folder.iterdir()}
    picture = (folder / "motion.svg").read_text()
    assert picture.count('id="Poly3DCollection_') == 15
    assert picture.count("<text") > 10
    for word in ("paths of the corners", "x [m]", "path of the origin"):
        assert word in picture
    page = (folder / "report.html").read_text()
    for word in ("joined C0 only", "132.7", "71.21", "80.97", "136.1", "531.2", "47.81", "15 instants"):
        assert word in page
    assert json.loads((folder / "law.json").read_text())["body"] == {"shape": [1.0, 1.5, 2.0]}
    assert run_verify(str(folder / "law.json"), as_json=False) == 0
    header = (folder / "samples.csv").read_text().splitlines()[0]
    assert header.endswith("jz,x,y,z,vx,vy,vz,segment,node")


def test_a_curve_of_orientations_alone_is_reported_without_a_translation(tmp_path):
    path = tmp_path / "c.yaml"
    path.write_text(HEAD + ONE + TAIL + "output: {rate: 20 Hz}\n")
    assert run(str(path), str(tmp_path / "out"), as_json=False) == 0
    page = (tmp_path / "out" / "report.html").read_text()
    assert "The way of the origin" not in page
    assert "Joints of the curves" not in page
    assert not (tmp_path / "out" / "motion.svg").exists()
