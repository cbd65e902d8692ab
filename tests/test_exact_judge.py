"""Promises of a certified law, one by one, against a judge in exact arithmetic; and samples of its campaigns."""

from itertools import pairwise

import numpy as np
import pytest

from tests.exact.arcs import make_case
from tests.exact.bounds import compare
from tests.exact.broken import list_broken, list_tolerable
from tests.exact.false_records import list_false_records
from tests.exact.handmade import (
    make_arcs,
    make_dwells,
    make_jump,
    make_law,
    make_pieces,
    make_steady,
    make_there_and_back,
)
from tests.exact.judge import judge
from tests.exact.limits import RATE_ORDERS, list_limited
from tests.exact.motion import Motion
from tests.exact.mutations import ACCEPTED, FAILED, FOUND, REFUSED, alter, examine, verify
from tests.exact.problems import PROBLEMS, list_laws
from timelaw.certificate import certify
from timelaw.law_file import from_document

BROKEN = [*list_broken(), *list_false_records()]
KEPT = {
    "two arcs": make_law(),
    "dwells": make_dwells(1.0, 2.0),
    "many pieces": make_pieces(),
    "two pieces": make_jump(0.0),
    "after others": make_jump(0.0, *make_arcs()),
    "a steady turn": make_steady(),
    **list_tolerable(),
    "there and back": make_law() | {"segments": make_there_and_back(), "duration": 4.0},
}
CASES, BOUNDS_LEAST = 30, 300
MUTATIONS = 40
SMALL = ("polynomial", "by axis", "torque", "wheels", "moving ends")  # designed in a second or so


BY_PROMISE = [pytest.param(promise, law, id=f"{promise} {what}") for promise, what, law in BROKEN]
BY_LAW = [pytest.param(law, id=f"{promise} {what}") for promise, what, law in BROKEN]


@pytest.mark.parametrize(("promise", "law"), BY_PROMISE)
def test_the_judge_sees_the_one_promise_that_is_broken(promise, law):
    assert {reason.split()[0] for reason in judge(law)} == {promise}


@pytest.mark.parametrize("law", BY_LAW)
def test_verify_finds_what_is_broken(law):
    assert verify(law)[0] in (FOUND, REFUSED)


@pytest.mark.parametrize("law", KEPT.values(), ids=KEPT)
def test_what_keeps_every_promise_is_accepted(law):
    assert judge(law) == []
    assert verify(law) == (ACCEPTED, [])


def largest_sampled(body, label, rates):
    """The largest of what a limit bounds among sampled rates (m, 3)."""
    name, axis = label.split(" on ")[0].partition(" ")[::2]
    if name in RATE_ORDERS:
        vectors, rest = rates[RATE_ORDERS[name]], 0.0
    elif name == "momentum":
        vectors, rest = rates[1] @ body.inertia.T, body.total_momentum
    elif body.actuator == "external":
        vectors = rates[2] @ body.inertia.T + np.cross(rates[1], rates[1] @ body.inertia.T)
        rest = 0.0
    else:
        vectors = rates[2] @ body.inertia.T
        across = np.delete(rates[1], "xyz".index(axis), axis=1) if axis else rates[1]
        rest = body.total_momentum * np.linalg.norm(across, axis=1)
    sizes = np.abs(vectors[:, "xyz".index(axis)]) if axis else np.linalg.norm(vectors, axis=1)
    return float(np.max(sizes + rest))


def test_exact_maxima_are_those_of_the_sampled_vectors():
    """Torque by Euler's equation and momentum in vectors, along each arc as the package evaluates it."""
    seen = set()
    for number in range(CASES):
        document = make_case(2, number)
        law = from_document(document)
        tau = np.concatenate([np.linspace(a, b, 500) for a, b in pairwise(law.segments[0].breaks)])
        rates = {
            k: np.concatenate([law.segments[0](tau, k, side) for side in ("left", "right")])
            for k in range(1, 5)
        }
        for one in list_limited(Motion(document)):
            if float(one.maximum) < 1e-3 * one.gross:
                continue  # what cancels is beyond doubles
            sampled = largest_sampled(law.body, one.label, rates)
            assert sampled <= float(one.maximum) * (1 + 1e-8)
            assert sampled >= float(one.maximum) * (1 - 1e-3)
            seen.add(one.label.split(" ")[0])
    assert seen == {"velocity", "acceleration", "jerk", "snap", "torque", "momentum"}


def test_no_proved_bound_is_lower_than_the_exact_maximum():
    compared = [one for number in range(CASES) for one in compare(make_case(1, number), number)]
    assert len(compared) >= BOUNDS_LEAST
    assert [one for one in compared if one.too_low] == []


@pytest.fixture(scope="module")
def laws():
    return list_laws(SMALL)


def test_designed_and_committed_laws_are_accepted_as_they_are(laws):
    outcomes = [one for name, law in laws.items() for one in examine(name, "", law, law)]
    assert [(one.law, one.findings, one.broken) for one in outcomes if one.row in FAILED] == []
    assert set(SMALL) <= set(PROBLEMS)


def test_no_altered_law_is_accepted_that_breaks_a_promise(laws):
    outcomes = []
    for number in range(MUTATIONS):
        name, kind, document = alter(laws, 1, number)
        outcomes += examine(name, kind, document, laws[name])
    assert [(one.law, one.kind, one.broken) for one in outcomes if one.row in FAILED] == []


@pytest.mark.parametrize(
    "change",
    [
        {"axis": [0.0, 0.0, 1e-200]},
        {"axis": [0.0, 0.0, 0.0]},
        {"start": [1e200, 0.0, 0.0, 0.0]},
        {"start_time": 1e308},
        {"start_time": -1e308},
    ],
)
@pytest.mark.parametrize("index", [0, 1])
def test_numbers_at_the_end_of_their_range_are_findings(change, index):
    document = make_law()
    document["segments"][index] |= change
    with np.errstate(over="ignore", invalid="ignore"):  # as the command has it
        assert certify(from_document(document)).findings()
