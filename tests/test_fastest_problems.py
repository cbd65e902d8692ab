"""Fastest tours of whole problem files, beside every order given as a list: rules, half-turns, rings."""

from itertools import permutations

import pytest

from timelaw.errors import InputError
from timelaw.pipeline import lay_out
from timelaw.requirements.route_limit import find_route_limit

LIMITS = "{velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3}"
VECTORS = "orientations: {as: rotation-vector, unit: deg, list: "
ROW = VECTORS + "[[0,0,0], [0,0,40], [0,0,90], [0,50,0], [0,0,150]]}"
HALF_TURNS = VECTORS + "[[0,0,0], [0,0,30], [0,0,210], [0,0,180], [0,70,0]]}"
RING = VECTORS + "[[0,0,0], [0,0,120], [0,0,240]]}"
RING_OF_FIVE = VECTORS + "[[0,0,0], [0,0,72], [0,0,144], [0,0,216], [0,0,288]]}"
CASES = {
    "row": (ROW, "", LIMITS),
    "row from and to": (f"{ROW}, start: 2, end: 5", "", LIMITS),
    "row, closed": (f"{ROW}, closed: true", "", LIMITS),
    "a slow node": (ROW, "nodes: {at: {2: {limits: {velocity: 5 deg/s}}}}", LIMITS),
    "slow nodes by axis": (
        f"{ROW}, closed: true",
        "nodes: {at: {1: {limits: {velocity: [9 deg/s, 30 deg/s, 40 deg/s]}}, 4: {limits: {jerk: 9 deg/s^3}}}}",
        LIMITS,
    ),
    "dwells": (ROW, "nodes: {dwell: 0.5 s, at: {2: {dwell: 0 s}}}", LIMITS),
    "a stop": (f"{ROW}, start: 1", "nodes: {at: {2: {stop: true}}}", LIMITS),
    "half-turns": (HALF_TURNS, "", LIMITS),
    "half-turns from and to": (f"{HALF_TURNS}, start: 1, end: 4", "", LIMITS),
    "half-turns, closed": (f"{HALF_TURNS}, closed: true", "", LIMITS),
    "half-turns by a stop": (f"{HALF_TURNS}, start: 1", "nodes: {at: {2: {stop: true}}}", LIMITS),
    "ring": (f"{RING}, closed: true", "", LIMITS),
    "ring of five": (f"{RING_OF_FIVE}, closed: true", "", LIMITS),
    "ring from": (f"{RING_OF_FIVE}, closed: true, start: 3", "", LIMITS),
    "ring by a stop": (
        f"{RING_OF_FIVE}, closed: true",
        "nodes: {at: {3: {stop: true}}}",
        "{acceleration: 9 deg/s^2}",
    ),
    "torque along one axis": (
        "orientations: {as: rotation-vector, unit: deg, list: "
        "[[1.9, 3.7, 5.6], [8.3, 16.6, 24.9], [17.1, 34.2, 51.3], [0, 0, 0], [0, 30, 0]]}",
        "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}",
        "{velocity: 60 deg/s, torque: 3 N*m}",
    ),
    "no velocity limit": (ROW, "", "{acceleration: 120 deg/s^2}"),
    "16-cell and a slow node": (
        "orientations: {lattice: 16-cell}",
        "nodes: {at: {3: {limits: {velocity: 1 deg/s}}}}",
        LIMITS,
    ),
    "torque": (
        f"{ROW}, start: 1, end: 2",
        "body: {inertia: [12 kg*m^2, 10 kg*m^2, 8 kg*m^2]}\n"
        "nodes: {at: {5: {limits: {torque: [1 N*m, 1 N*m, 0.1 N*m]}}}}",
        "{velocity: 60 deg/s, torque: [2 N*m, 1 N*m, 3 N*m]}",
    ),
}


def laid_out(folder, route, more, limits, tour):
    path = folder / "p.yaml"
    path.write_text(f"timelaw: 1\nname: p\nroute: {{{route}, tour: {tour}}}\nlimits: {limits}\n{more}\n")
    layout = lay_out(path)
    return layout, find_route_limit(layout.route, layout.requirements)


LONGER = {
    "ring from",
    "no velocity limit",
    "half-turns by a stop",
    "row, closed",
    "dwells",
    "half-turns, closed",
    "half-turns from and to",
    "ring",
    "ring of five",
}


@pytest.mark.parametrize(
    "case",
    [pytest.param(case, marks=pytest.mark.campaign) if case in LONGER else case for case in CASES],
)
def test_no_order_is_faster(case, tmp_path):
    route, more, limits = CASES[case]
    layout, time = laid_out(tmp_path, route, more, limits, "fastest")
    labels, order = layout.orientations.labels, layout.tour.order
    merit = next(merit for merit in layout.tour.merits if merit.name == "time")
    assert merit.value == pytest.approx(time, rel=1e-9)
    spec = layout.problem.route
    bare = route.replace(f", start: {spec.start}", "").replace(f", end: {spec.end}", "")
    orders = [o for o in permutations(labels) if spec.start in (None, o[0]) and spec.end in (None, o[-1])]
    stop = more.partition("{at: {")[2][:1] if "stop: true" in more else None
    times = []
    for o in orders:
        ends = (o[0],) if spec.closed else (o[0], o[-1])
        rules = "" if stop in ends else more  # in a list, a stop at an end is refused
        times.append(laid_out(tmp_path, bare, rules, limits, list(map(int, o)))[1])
    assert tuple(labels[i] for i in order) in orders
    assert time == pytest.approx(min(times), rel=1e-9)
    assert merit.bound <= time * (1 + 1e-9)
    if "half-turns" not in case:  # where a half-turn could go either way the bound may be lower
        assert merit.is_best


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (
            "nodes: {start: {velocity: 30 deg/s}}",
            '5:16: nodes.start: "fastest" compares motions from rest to rest',
        ),
        (
            "nodes: {end: {velocity: 30 deg/s}}",
            '5:14: nodes.end: "fastest" compares motions from rest to rest',
        ),
        (
            "nodes: {at: {2: {time: 3 s}}}",
            '5:24: nodes.at.2.time: "fastest" compares motions from rest to rest, whenever they begin',
        ),
        (
            "segments: {1-2: {duration: 3 s}}",
            '5:17: segments.1-2: "fastest" chooses the legs; give the tour it finds as a list or with given',
        ),
        (
            "nodes: {at: {9: {dwell: 3 s}}}",
            '5:17: nodes.at.9: no orientation is called "9"; there are 1, 2, 3, 4, 5',
        ),
    ],
)
def test_rules_that_need_a_route_are_refused(more, message, tmp_path):
    with pytest.raises(InputError) as error:
        laid_out(tmp_path, ROW, more, LIMITS, "fastest")
    assert str(error.value) == f"{tmp_path / 'p.yaml'}:{message}"


def test_too_many_runs_on_axes_known_roughly_without_a_velocity_limit_leave_no_bound(tmp_path, capsys):
    from timelaw.cli.tour import run

    vectors = [[0, 0, a] for a in range(0, 150, 7)]
    route = f"{VECTORS}{vectors}, precision: 0.01 deg}}"
    laid_out(tmp_path, route, "", "{acceleration: 120 deg/s^2}", "fastest")
    assert run(str(tmp_path / "p.yaml"), None, table=False, as_json=True) == 0
    captured = capsys.readouterr()
    assert "no bound is known for how much faster a tour can be" in captured.err
    assert '"gap": null' in captured.out
