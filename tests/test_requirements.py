"""Node and leg rules, from the problem file to the certified law."""

import json

import numpy as np
import pytest

from tests.cases import PROBLEMS
from timelaw import design
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.errors import InfeasibleError, InputError
from timelaw.export import format_law
from timelaw.law_file.document import from_document

BASE = (PROBLEMS / "paper-24-cell.yaml").read_text()


def make(tmp_path, *lines, **replacements):
    text = BASE.replace("nodes: {continuity: 2}", "").replace("objective: time\n", "")
    for key, value in replacements.items():
        text = text.replace(key, value)
    path = tmp_path / "p.yaml"
    path.write_text(text + "\n".join(lines) + "\n")
    return design(path)


def verified(designed):
    document = json.loads(format_law(designed.optimised.law, designed.optimised.certificate, {}))
    certificate = certify(from_document(document))
    assert certificate.findings() == []
    assert compare_with_record(certificate, document) == []
    return designed.optimised.law


def test_dwells_are_rests_and_never_merged(tmp_path):
    designed = make(tmp_path, "nodes: {dwell: 0.5 s, at: {7: {dwell: 2 s}, 9: {dwell: 0 s}}}")
    law = verified(designed)
    dwells = {s.at: s.duration for s in law.segments if s.kind == "dwell"}
    assert dwells == {label: (2.0 if label == "7" else 0.5) for label in law.labels if label != "9"}
    assert len([s for s in law.segments if s.kind == "arc"]) == 11
    for segment in law.segments:
        if segment.kind == "dwell":
            t = np.linspace(segment.start_time, segment.end_time, 7)
            assert np.max(np.abs(law(t[1:-1], 1))) == 0
            np.testing.assert_allclose(law(t) @ segment.orientation, 1, atol=1e-15)
    # three straight nodes have become stops: 11 legs from stop to stop at 2.859 s, 0.5 s at 10 nodes, 2 s at one
    assert law.duration == pytest.approx(11 * 2.858994 + 10 * 0.5 + 2.0, rel=1e-6)


def test_a_closed_tour_dwells_once_where_it_began(tmp_path):
    law = verified(make(tmp_path, "nodes: {dwell: 1 s}", **{"tour: paper": "tour: shortest\n  closed: true"}))
    assert [s.at for s in law.segments if s.kind == "dwell"].count("1") == 1


def test_a_forced_stop_costs_what_the_run_saved(tmp_path):
    law = verified(make(tmp_path, "nodes: {at: {11: {stop: true}}}"))
    assert law.duration == pytest.approx(7 * 2.858994 + 2 * 4.844636, rel=1e-6)
    assert np.linalg.norm(law(law.times[2], 1)) == 0


def test_slower_legs_and_fixed_durations(tmp_path):
    designed = make(tmp_path, "segments: {8-10: {limits: {velocity: 10 deg/s}}, 6-5: {duration: 4 s}}")
    law = verified(designed)
    slow = next(s for s in law.segments if s.name == "8–10")
    t = np.linspace(slow.start_time, slow.end_time, 999)
    assert np.degrees(np.max(np.linalg.norm(law(t, 1), axis=1))) == pytest.approx(10, rel=1e-4)
    assert next(s for s in law.segments if s.name == "6–5").duration == pytest.approx(4.0, rel=1e-14)
    assert [c.limit for c in designed.optimised.certificate.limits][-1] == "velocity on 8–10"


def test_limits_at_a_node_hold_on_the_legs_that_meet_there(tmp_path):
    rules = (
        "nodes: {at: {8: {limits: {velocity: 20 deg/s}}}}\nsegments: {8-10: {limits: {velocity: 10 deg/s}}}"
    )
    law = verified(make(tmp_path, rules))
    limits = {s.name: np.degrees(s.limits["velocity"]) for s in law.segments if s.limits}
    assert limits == pytest.approx({"3–8": 20, "8–10": 10})


@pytest.mark.campaign
def test_splines_of_every_degree_and_continuity(tmp_path):
    for degree, continuity in ((3, 2), (6, 4), (7, 4), (7, 2)):
        easing = f"{{basis: spline, degree: {degree}, intervals: 40}}"
        designed = make(
            tmp_path, f"nodes: {{continuity: {continuity}}}", **{"{basis: polynomial, degree: 9}": easing}
        )
        verified(designed)
        assert designed.optimised.certificate.duration <= 27.6 * 1.03


def test_arrival_times_are_met(tmp_path):
    law = verified(make(tmp_path, "nodes: {dwell: 0.5 s, at: {3: {time: 12 s}, 4: {time: 60 s}}}"))
    arrival = {s.target: s.end_time for s in law.segments if s.kind == "arc"}
    assert arrival["3"] == pytest.approx(12.0, rel=1e-12)
    assert arrival["4"] == pytest.approx(60.0, rel=1e-12)


def test_a_motion_that_begins_and_ends_moving(tmp_path):
    law = verified(
        make(
            tmp_path,
            "nodes: {start: {velocity: 20 deg/s}, end: {velocity: 10 deg/s, acceleration: -30 deg/s^2}}",
        )
    )
    assert np.degrees(np.linalg.norm(law(0.0, 1))) == pytest.approx(20, rel=1e-12)
    assert np.degrees(np.linalg.norm(law(law.duration, 1))) == pytest.approx(10, rel=1e-9)
    assert np.degrees(np.linalg.norm(law(law.duration, 2))) == pytest.approx(30, rel=1e-9)


@pytest.mark.parametrize(("continuity", "degree"), [(1, 9), (2, 9), (3, 9), (4, 11)])
def test_the_continuity_that_is_asked_for_is_proved(tmp_path, continuity, degree):
    limits = {"  jerk: 600 deg/s^3\n": ""} if continuity == 1 else {}
    replacements = {"degree: 9": f"degree: {degree}", **limits}
    designed = make(tmp_path, f"nodes: {{continuity: {continuity}}}", **replacements)
    verified(designed)
    assert designed.optimised.certificate.continuity.order == continuity


FAULTS = {
    "nodes: {at: {13: {stop: true}}}": 'nodes.at.13: the tour has no node "13"; it has 1, 12, 11, 3, 8, 10, … (12 in all)',
    "nodes: {at: {1: {stop: true}}}": 'nodes.at.1: "1" is where the motion starts or ends; "stop" and a start time have no meaning there',
    "segments: {1-2: {duration: 4 s}}": 'segments.1-2: the tour has no leg "1-2"; it has 1-12, 12-11, 11-3, 3-8, 8-10, 10-2, … (11 in all)',
    "segments: {1-12: {}}": 'segments.1-12: give "duration", "limits" or both',
    "segments: {1-12: {limits: {torque: 1 N*m}}}": 'segments.1-12.limits.torque: a limit on the torque needs "body: {inertia: …}"',
    "segments: {1-12: {limits: {speed: 1 N*m}}}": 'segments.1-12.limits: unknown key "speed"; allowed: velocity, acceleration, jerk, snap, torque, momentum, linear_velocity, linear_acceleration',
    "nodes: {at: {7: {dwel: 2 s}}}": 'nodes.at.7: unknown key "dwel"; allowed: dwell, stop, time, limits; did you mean "dwell"?',
    "nodes: {start: {velocity: 1 deg/s}, at: {1: {dwell: 1 s}}}": 'nodes.at.1.dwell: the motion begins or ends moving at "1", where it cannot dwell',
    "nodes: {start: {velocity: 1 deg/s, jerk: 2 deg/s^3}}": "nodes.start.jerk: the jerk jumps with continuity 2; ask for 3",
    "objective: {minimise: snap, total_time: 60 s}": "objective.minimise: to minimise snap, continuity 3 at the nodes is needed, not 2",
    "nodes: {dwell: -1 s}": 'nodes.dwell: "-1 s" is out of range; 0 to 1e+09 s are allowed',
    "nodes: {continuity: 1}": "limits.jerk: a limit on the jerk needs continuity 2 at the nodes, not 1",
    "body: {inertia: [1 kg*m^2, 1 kg*m^2]}": "body.inertia: three principal moments or three rows of three are needed",
    "body: {inertia: [1 kg*m^2, 1 kg*m^2, 3 kg*m^2]}": "body.inertia: no body has the moments 1, 1, 3 kg*m^2: one is above the sum of the others",
    "body: {inertia: [[2 kg*m^2, 1 kg*m^2, 0], [0, 2 kg*m^2, 0], [0, 0, 2 kg*m^2]]}": "body.inertia: the inertia matrix is not symmetric",
    "body: {inertia: [[1 kg*m^2, 2 kg*m^2, 0], [2 kg*m^2, 1 kg*m^2, 0], [0, 0, 1 kg*m^2]]}": "body.inertia: the principal moments -1, 1, 3 kg*m^2 must be positive",
    "objective: {minimise: jerk}": 'objective: to minimise jerk, give either "total_time" or "weight"',
    "objective: {minimise: time, total_time: 3 s}": "objective: least time leaves no room for total_time; minimise jerk, energy, torque, snap or peak",
    "objective: {minimise: torque, total_time: 60 s}": 'objective.minimise: to minimise torque, "body: {inertia: …}" is needed',
    "objective: {minimise: jerk, total_time: 0.5 x minimum}": 'objective.total_time: "0.5 x minimum"; a factor of at least 1 is needed, as in "1.5 x minimum"',
    "objective: {minimise: peak, weight: 2}": "objective: peak is made least in a given total_time, not against a weight",
    "objective: {minimise: jrk, total_time: 60 s}": 'objective.minimise: "jrk"; allowed: time, jerk, energy, torque, snap, peak; did you mean "jerk"?',
}  # fmt: skip


@pytest.mark.parametrize("line", FAULTS)
def test_rules_that_make_no_sense(tmp_path, line):
    with pytest.raises(InputError) as error:
        make(tmp_path, line)
    assert str(error.value).split(": ", 1)[1] == FAULTS[line]


IMPOSSIBLE = {
    "objective: {minimise: jerk, total_time: 20 s}": "20 s is too early for the end: the earliest possible is 28.8289 s, 8.82888 s later",
    "nodes: {at: {3: {time: 7 s}}}": "7 s is too early for arrival at 3: the earliest possible is 7.70363 s, 0.703631 s later",
    "nodes: {at: {3: {time: 12 s}, 8: {time: 12.5 s}}}": "nodes.at.8.time: within the given times the limits would have to be 12.6042 times as large",
    "segments: {1-12: {duration: 2.5 s}}": "within the given durations the limits would have to be 1.16",
    "nodes: {at: {12: {time: 8 s}}}\nsegments: {1-12: {duration: 5 s}}": "fixed durations put arrival at 12 at 5 s",
    "nodes: {at: {3: {time: 8 s}}}\nsegments: {1-12: {duration: 5 s}}": "8 s is too early for arrival at 3: the earliest possible is 9.84464 s",
}  # fmt: skip


EASINGS = {
    "{basis: double-s}\nsegments: {1-12: {duration: 5 s}}": "easing.basis: a double-s has the least time from rest to rest; it keeps no given times",
    "{basis: double-s}\nnodes: {continuity: 3}": "easing.basis: under these limits a double-s has continuity 2, not 3: 2 where the jerk is limited, 1 where acceleration or torque is, 0 where neither is",
    "{basis: spline, degree: 3}\nnodes: {continuity: 3}": "easing.degree: 3; continuity 3 at the nodes needs degree 4 or more",
    "{basis: spline, within: 1 %}": "easing.within: within belongs to the basis auto, not to spline",
    "{basis: auto, within: 0 %}": 'easing.within: "0 %"; a part from 0.001 % to less than 100 % is needed, like "1 %"',
}  # fmt: skip


@pytest.mark.parametrize("easing", EASINGS)
def test_easings_that_make_no_sense(tmp_path, easing):
    with pytest.raises(InputError) as error:
        make(tmp_path, **{"{basis: polynomial, degree: 9}": easing})
    assert str(error.value).split(": ", 1)[1] == EASINGS[easing]


def test_snap_alone_is_not_enough(tmp_path):
    with pytest.raises(InputError, match="snap alone is not enough"):
        make(tmp_path, **{BASE[BASE.index("  velocity") : BASE.index("nodes:")]: "  snap: 9 deg/s^4\n"})


def test_an_arrival_inside_a_run_may_be_earlier_than_on_the_way_to_the_earliest_end(tmp_path):
    """60° and then 10° about x: to be at the end soonest the body brakes late, to be at the node sooner it need not."""
    list_ = "{list: [[1, 0, 0, 0], [0.8660254037844386, 0.5, 0, 0], [0.8191520442889918, 0.573576436351046, 0, 0], [0, 0, 1, 0]]}"
    replacements = {
        "{lattice: 24-cell}": list_,
        "tour: paper": "tour: given",
        "60 deg/s": "90 deg/s",
        "120 deg/s^2": "180 deg/s^2",
        "600 deg/s^3": "1200 deg/s^3",
    }
    soonest = make(tmp_path, **replacements).optimised.law.times[1]
    law = verified(make(tmp_path, f"nodes: {{at: {{2: {{time: {0.98 * soonest:.6f} s}}}}}}", **replacements))
    assert law.times[1] == pytest.approx(0.98 * soonest, rel=1e-6)


def test_what_is_fixed_stays_fixed_also_next_to_the_least_total_time(tmp_path):
    lines = [
        "segments: {1-12: {duration: 3.2 s}}",
        "objective: {minimise: jerk, total_time: 1.000008 x minimum}",
    ]
    law = verified(make(tmp_path, *lines))
    assert law.segments[0].duration == pytest.approx(3.2, rel=1e-12)


def test_a_weight_is_not_forgotten_for_an_early_arrival(tmp_path):
    lines = ["nodes: {at: {12: {time: 2.859 s}}}", "objective: {minimise: jerk, weight: 10}"]
    assert verified(make(tmp_path, *lines)).duration > 1.2 * 28.83


@pytest.mark.parametrize("basis", ["spline", "auto"])
def test_without_a_jerk_limit_the_continuity_is_still_kept(tmp_path, basis):
    designed = make(
        tmp_path, **{"{basis: polynomial, degree: 9}": f"{{basis: {basis}}}", "  jerk: 600 deg/s^3\n": ""}
    )
    verified(designed)
    assert designed.optimised.certificate.continuity.order >= 2


def test_splines_of_continuity_4_are_certified_so(tmp_path):
    easing = {"{basis: polynomial, degree: 9}": "{basis: spline}"}
    designed = make(tmp_path, "nodes: {continuity: 4}", **easing)
    verified(designed)


def test_auto_knows_that_a_moving_motion_may_be_faster(tmp_path):
    ends = "nodes: {start: {velocity: 50 deg/s}, end: {velocity: 50 deg/s}}"
    list_ = {
        "{lattice: 24-cell}": "{list: [[1, 0, 0, 0], [0.5, 0.8660254037844386, 0, 0]]}",
        "tour: paper": "tour: given",
    }
    nine = verified(make(tmp_path, ends, **list_)).duration
    auto = verified(
        make(tmp_path, ends, **{**list_, "{basis: polynomial, degree: 9}": "{basis: auto}"})
    ).duration
    assert auto <= nine


@pytest.mark.parametrize("lines", IMPOSSIBLE)
def test_demands_that_cannot_be_met_say_what_would_have_to_give(tmp_path, lines):
    with pytest.raises(InfeasibleError) as error:
        make(tmp_path, lines)
    assert IMPOSSIBLE[lines] in str(error.value)
    assert error.value.exit_code == 3


def test_the_double_s_keeps_fixed_durations_and_is_as_smooth_as_ever(tmp_path):
    """A fixed leg in the middle of a run: the profile is cut where it begins and ends, or ω would jump there."""
    designed = make(tmp_path, "segments: {12-11: {duration: 5 s}}")
    for entry in designed.baselines:
        fixed = next(s for s in entry.law.segments if s.name == "12–11")
        assert fixed.duration == pytest.approx(5.0, rel=1e-12)
        assert entry.certificate.continuity.order >= 2 - (entry.name != "quintic")


@pytest.mark.parametrize(
    ("easing", "factor"),
    [
        ("{basis: polynomial, degree: 9}", 1.0),
        ("{basis: polynomial, degree: 9}", 1 - 5e-7),
        ("{basis: spline, degree: 5, intervals: 8}", 1 + 1e-7),
        ("{basis: spline, degree: 5, intervals: 8}", 1 + 3e-6),
    ],
)
def test_with_hardly_any_room_the_least_peak_holds_its_limits_or_is_refused(tmp_path, factor, easing):
    """The earliest arrival at a node and at the end, more or less rounding: no law 1e-7 above its limits."""
    lines = (f"easing: {easing}",)
    base = {"easing: {basis: polynomial, degree: 9}": ""}
    least = make(tmp_path, *lines, **base).optimised.law
    first = next(s for s in least.segments if s.target == "3")
    given = (
        f"nodes: {{at: {{3: {{time: {first.end_time * factor!r} s}}}}}}",
        f"objective: {{minimise: peak, total_time: {least.duration * factor!r} s}}",
    )
    try:
        designed = make(tmp_path, *lines, *given, **base)
    except InfeasibleError as error:
        refused = error.faults[0].message
    else:
        verified(designed)
        return
    assert factor < 1 + 1e-6
    assert "the limits would have to be 1.0000" in refused or "s is too early for" in refused
