"""Reaction wheels: what their torque is, by integrating Euler's equations of a body with three wheels."""

import json
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from tests.cases import PROBLEMS
from timelaw import design
from timelaw.certificate import certify
from timelaw.certificate.record import compare_with_record
from timelaw.errors import InputError
from timelaw.export import format_law
from timelaw.law_file.document import from_document
from timelaw.limits import list_rows, make_limits
from timelaw.limits.body import RigidBody

INERTIA = np.array([[12.0, 1.0, -0.5], [1.0, 10.0, 0.7], [-0.5, 0.7, 8.0]])
WHEEL = 0.02  # kg m², of each wheel about its axis
PROBLEM = """\
timelaw: 1
name: wheels
route:
  orientations:
    list: [[1, 0, 0, 0], [0.8, 0.36, 0.48, 0], [0.5, 0.5, -0.5, 0.5], [0.6, 0, 0, 0.8]]
body:
  inertia: [[12 kg*m^2, 1 kg*m^2, -0.5 kg*m^2], [1 kg*m^2, 10 kg*m^2, 0.7 kg*m^2], [-0.5 kg*m^2, 0.7 kg*m^2, 8 kg*m^2]]
  actuator: wheels
  momentum: [MOMENTUM]
limits: {torque: TORQUE, momentum: STORED, jerk: 20 deg/s^3}
easing: {degree: 9}
"""
CASES = {
    "no net momentum": ("0 N*m*s, 0 N*m*s, 0 N*m*s", "[0.4 N*m, 0.3 N*m, 0.5 N*m]", "3 N*m*s"),
    "by norm": ("0 N*m*s, 0 N*m*s, 0 N*m*s", "0.4 N*m", "[3 N*m*s, 3 N*m*s, 3 N*m*s]"),
    "with net momentum": ("0.2 N*m*s, -0.3 N*m*s, 0.6 N*m*s", "[0.4 N*m, 0.3 N*m, 0.5 N*m]", "4 N*m*s"),
    "with it by norm": ("0.2 N*m*s, -0.3 N*m*s, 0.6 N*m*s", "0.4 N*m", "[4 N*m*s, 3 N*m*s, 3 N*m*s]"),
}  # fmt: skip


def make(tmp_path, momentum, torque, stored, **changes):
    text = PROBLEM.replace("MOMENTUM", momentum).replace("TORQUE", torque).replace("STORED", stored)
    for old, new in changes.items():
        text = text.replace(old, new)
    (tmp_path / "wheels.yaml").write_text(text)
    return design(tmp_path / "wheels.yaml")


def driven(law, total):
    """Motors' torques (n, 3) and wheels' momenta (n, 3) along the law, and the error of the attitude [rad].

    Body and wheels: J ω' + ω × (J ω + h) = -u, h' = u, h (3,) the wheels' momenta about the body axes and u
    the motors' torques. The attitude is integrated from u alone and compared with the law's.
    """

    def motor(t):
        omega, alpha = law(t, 1), law(t, 2)
        turned = Rotation.from_quat(law(t), scalar_first=True)
        h_body = turned.inv().apply(total)  # constant in the world
        return -(INERTIA @ alpha) - np.cross(omega, h_body)

    def dynamics(t, state):
        q, omega, h = state[:4], state[4:7], state[7:]
        u = motor(min(max(t, 0.0), law.duration))
        alpha = np.linalg.solve(INERTIA, -u - np.cross(omega, INERTIA @ omega + h))
        w, v = q[0], q[1:]
        rate = 0.5 * np.concatenate([[-v @ omega], w * omega + np.cross(v, omega)])
        return np.concatenate([rate, alpha, u])

    state = np.concatenate([law(0.0), np.zeros(3), total])
    states, motors = [state], []
    breaks = np.unique(np.concatenate([s.start_time + s.duration * s.breaks for s in law.segments]))
    for a, b in pairwise(breaks):
        inner = np.linspace(a, b, 41)
        done = solve_ivp(dynamics, (a, b), states[-1], rtol=1e-10, atol=1e-12, t_eval=inner, method="DOP853")
        states += list(done.y.T[1:])
        motors += [motor(t) for t in inner]
    times = np.concatenate([[0.0], *(np.linspace(a, b, 41)[1:] for a, b in pairwise(breaks))])
    found = Rotation.from_quat(np.array(states)[:, :4], scalar_first=True)
    error = (found.inv() * Rotation.from_quat(law(times), scalar_first=True)).magnitude()
    return np.array(motors), np.array(states)[:, 7:], float(np.max(error))


@pytest.mark.parametrize("name", CASES)
def test_the_wheels_torque_is_that_of_eulers_equations_with_three_wheels(tmp_path, name):
    """The attitude follows from the motors' torques alone, and these stay within the limits, near to them."""
    designed = make(tmp_path, *CASES[name])
    law, certificate = designed.optimised.law, designed.optimised.certificate
    assert certificate.findings() == []
    total = law.body.momentum
    motors, stored, error = driven(law, total)
    assert error < 1e-6
    checks = {check.limit: check for check in certificate.limits}
    for quantity, values in (("torque", motors), ("momentum", stored)):
        by_axis = {f"{quantity} {axis}": values[:, i] for i, axis in enumerate("xyz")}
        seen = {quantity: np.linalg.norm(values, axis=1), **by_axis}
        for label in {check.limit for check in certificate.limits if check.limit.startswith(quantity)}:
            largest = float(np.max(np.abs(seen[label])))
            assert largest <= checks[label].upper * (1 + 1e-6)
            if not any(total):
                assert largest == pytest.approx(checks[label].peak, rel=1e-3)
            assert bool(checks[label].note) == bool(any(total))
    assert max(check.ratio for check in certificate.limits) > 0.999


@pytest.mark.parametrize("name", CASES)
def test_a_law_for_wheels_reads_back_and_verifies(tmp_path, name):
    designed = make(tmp_path, *CASES[name])
    document = json.loads(format_law(designed.optimised.law, designed.optimised.certificate, {}))
    assert document["body"]["actuator"] == "wheels"
    read = certify(from_document(document))
    assert read.findings() == []
    assert compare_with_record(read, document) == []
    altered = json.loads(json.dumps(document))
    altered["body"] = {"inertia": altered["body"]["inertia"]}
    assert compare_with_record(certify(from_document(altered)), altered)


def test_a_total_momentum_without_wheels_is_refused_in_a_law_file(tmp_path):
    designed = make(tmp_path, *CASES["with net momentum"])
    document = json.loads(format_law(designed.optimised.law, designed.optimised.certificate, {}))
    document["body"]["actuator"] = "external"
    with pytest.raises(InputError, match="a total momentum belongs to the actuator"):
        from_document(document)


def test_a_limit_that_rounding_alone_leaves_above_the_total_momentum_is_refused(tmp_path):
    total = float(np.linalg.norm([0.2, -0.3, 0.6]))  # 0.7 but for the last digit
    with pytest.raises(InputError, match="a limit above it is needed"):
        make(tmp_path, "0.2 N*m*s, -0.3 N*m*s, 0.6 N*m*s", "0.4 N*m", f"{np.nextafter(total, 1)} N*m*s")


def test_what_the_wheels_do_is_not_what_a_torque_from_outside_would_do(tmp_path):
    wheels = make(tmp_path, *CASES["no net momentum"])
    external = make(tmp_path, *CASES["no net momentum"], **{"  actuator: wheels\n": "", "  momentum: [0 N*m*s, 0 N*m*s, 0 N*m*s]\n": ""})  # fmt: skip
    assert abs(external.optimised.law.duration / wheels.optimised.law.duration - 1) > 1e-3


@pytest.mark.parametrize("seed", range(20))
def test_the_rows_with_net_momentum_bound_every_direction_of_it_and_one_is_reached(seed):
    """|(Jα + ω×H)_i| ≤ |J n|_i |φ''| + |H| √(1 - n_i²) |φ'| for all H of a size, with equality for some."""
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    size, first, second = 0.7, float(rng.normal()), float(rng.normal())
    body = RigidBody(INERTIA, "wheels", np.array([0.0, 0.0, size]))
    for bounds in ({"torque": 1.0, "momentum": 2.0}, {"torque": (1.0,) * 3, "momentum": (2.0,) * 3}):
        worst: dict[str, float] = {}
        for row in list_rows(make_limits(bounds, body), axis):
            value = row.size(abs(row.value({1: first, 2: second})))
            worst[row.label] = max(worst.get(row.label, 0.0), value)
        h = rng.normal(size=(20000, 3))
        h *= size / np.linalg.norm(h, axis=1, keepdims=True)
        torque = INERTIA @ axis * second + np.cross(axis * first, h)
        stored = h - INERTIA @ axis * first
        for quantity, vectors in (("torque", torque), ("momentum", stored)):
            norms = {quantity: np.linalg.norm(vectors, axis=1)}
            seen = norms if quantity in worst else {f"{quantity} {a}": np.abs(vectors[:, i]) for i, a in enumerate("xyz")}  # fmt: skip
            for label, values in seen.items():
                assert np.max(values) <= worst[label] * (1 + 1e-12)
                if (
                    quantity == "momentum" or label != quantity
                ):  # of the torque's norm the two parts are not parallel
                    assert np.max(values) > 0.97 * worst[label]


FAULTS = {
    ("  momentum: [0 N*m*s", "  momentum: [4 N*m*s"): "limits.momentum: the total momentum |H| is 4 N*m*s; a limit above it is needed, not 3 N*m*s",
    ("  actuator: wheels\n", ""): 'body.momentum: it belongs to "actuator: wheels"',
    ("actuator: wheels", "actuator: wheel"): 'body.actuator: "wheel"; allowed: external, wheels; did you mean "wheels"?',
    ("momentum: [0 N*m*s, 0 N*m*s, 0 N*m*s]", "momentum: 1 N*m*s"): "body.momentum: three components in body axes are needed, as in [0 N*m*s, 0 N*m*s, 0.2 N*m*s]",
    ("momentum: [0 N*m*s, 0 N*m*s, 0 N*m*s]", "momentum: [0 N*m*s, 0 N*m, 0 N*m*s]"): 'body.momentum: "0 N*m" is not an angular momentum; write it like "4 N*m*s"',
    ("momentum: [0 N*m*s, 0 N*m*s, 0 N*m*s]\n", "momentum: [0 N*m*s, 0 N*m*s, 1 N*m*s]\nobjective: {minimise: torque, total_time: 90 s}\n"): "objective.minimise: to minimise torque, a total momentum of zero is needed: H turns against the body; minimise energy instead",
}  # fmt: skip


@pytest.mark.parametrize("change", FAULTS, ids=lambda change: change[1][:40])
def test_bodies_that_make_no_sense(tmp_path, change):
    with pytest.raises(InputError) as error:
        make(tmp_path, *CASES["no net momentum"], **dict([change]))
    assert str(error.value).split(": ", 1)[1] == FAULTS[change]


def test_a_law_file_with_more_momentum_than_the_limit_is_refused(tmp_path):
    designed = make(tmp_path, *CASES["with net momentum"])
    document = json.loads(format_law(designed.optimised.law, designed.optimised.certificate, {}))
    document["body"]["momentum"] = [0, 0, 5]
    with pytest.raises(InputError, match=r"limits.momentum: the total momentum \|H\| is 5"):
        from_document(document)


def test_the_shipped_example_is_designed_with_wheels():
    body = design(PROBLEMS / "reaction-wheel-slew.yaml").requirements.body
    assert body.actuator == "wheels"
    assert not any(body.momentum)
