"""Values of a law at many instants: against exact numbers, in any order, from both sides, in little memory."""

import tracemalloc
from math import comb

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from tests.exact.curves import Curve, solve_rates
from tests.exact.motion import Motion
from tests.exact.quaternions import multiply
from tests.exact.rational import read, read_all, root
from tests.laws import LAWS, law_of
from timelaw.law_file import from_document
from timelaw.law_file.document import to_document
from timelaw.motion import evaluation
from timelaw.motion.evaluation import STACKS
from timelaw.motion.kinds import KINDS
from timelaw.numerics.chebyshev import expand_basis

ORDERS = range(5)
NEAR = 1e-14  # of the largest value of the order


def find_largest(law, order):
    return np.max(np.abs(law(np.linspace(0, law.duration, 2001), order)))


def place_exactly(segment, t):
    """The piece that holds an instant, and its u."""
    passed = read(t) - segment.begins
    for piece in segment.pieces:
        if passed < piece.duration or piece is segment.pieces[-1]:
            return piece, passed / piece.duration
        passed -= piece.duration
    raise AssertionError


def evaluate_exactly(motion, index, t):
    """Orientation and rates by order in exact numbers, or balls."""
    segment = motion.segments[index]
    if not segment.moves:
        q = read_all(segment.data["orientation"])
        return [[x / root(sum(x * x for x in q)) for x in q], *([[fmpq(0)] * 3] * 4)]
    piece, u = place_exactly(segment, t)
    if isinstance(piece, Curve):
        q = [[p(u) for p in own] for own in piece.derivatives]
        size = root(sum((x * x for x in q[0]), fmpq(0)))
        return [[x / size for x in q[0]], *(solve_rates(q)[order] for order in range(1, 5))]
    half = arb(piece.rate(0)(u)) / 2
    turn = [half.cos(), *(half.sin() * x / segment.length for x in segment.axis)]
    start = read_all(segment.data["start"])
    size = root(sum((x * x for x in start), fmpq(0)))
    rates = [segment._along(piece.rate(order)(u)) for order in range(1, 5)]
    return [multiply([x / size for x in start], turn), *rates]


def measure_errors(law, times):
    """By order, the largest error over the largest value."""
    motion, values = Motion(to_document(law) | {"body": None}), law.evaluate(times, ORDERS)
    index = np.clip(np.searchsorted(law.times, times, side="right") - 1, 0, len(law.segments) - 1)
    worst = np.zeros(5)
    ctx.prec = 200
    for i, (t, k) in enumerate(zip(times.tolist(), index.tolist(), strict=True)):
        exact = evaluate_exactly(motion, k, t)
        for order in ORDERS:
            pairs = zip(exact[order], values[order][i].tolist(), strict=True)
            off = max(abs(float(arb(a) - arb(b))) for a, b in pairs)
            worst[order] = max(worst[order], off)
    return worst / [max(find_largest(law, order), 1e-300) for order in ORDERS]


@pytest.mark.parametrize("name", LAWS)
def test_values_are_those_of_exact_numbers(name):
    law = law_of(name)
    times = np.sort(np.random.default_rng(3).uniform(0, law.duration, 40))
    assert np.all(measure_errors(law, times) <= NEAR)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("side", ["left", "right"])
def test_values_are_those_of_the_segments_own_scheme(name, side):
    """De Casteljau's, by its own way to the piece, at instants in order."""
    law = law_of(name)
    times = np.linspace(0, law.duration, 4001)
    for order, value in zip(ORDERS, law.evaluate(times, ORDERS, side), strict=True):
        wanted = np.empty_like(value)
        for segment, here, tau in law._find(times, side):
            wanted[here] = segment(tau, order, side)
        np.testing.assert_allclose(value, wanted, rtol=0, atol=NEAR * find_largest(law, order))


@pytest.mark.parametrize("name", LAWS)
def test_the_same_bits_in_any_order_and_number(name, monkeypatch):
    """Long runs on a piece, short ones, instants in no order, one by one, several orders or one."""
    law = law_of(name)
    rng = np.random.default_rng(4)
    times = np.sort(np.concatenate([rng.uniform(0, law.duration, 3000), law.times]))
    wanted = law.evaluate(times, ORDERS)
    mixed = rng.permutation(len(times))
    for order, value in zip(ORDERS, wanted, strict=True):
        np.testing.assert_array_equal(law(times[mixed], order), value[mixed])
        np.testing.assert_array_equal([law(t, order) for t in times[::300]], value[::300])
    for block, long in ((64, 0), (64, 1000), (1000, 10)):
        monkeypatch.setattr(evaluation, "BLOCK", block)
        monkeypatch.setattr(evaluation, "CUT", 4 * block)
        monkeypatch.setattr(evaluation, "LONG", long)
        for value, again in zip(wanted, law.evaluate(times, ORDERS), strict=True):
            np.testing.assert_array_equal(again, value)


@pytest.mark.parametrize("name", ["spline", "curves", "mixed"])
def test_both_sides_of_every_break_are_the_ends_of_the_pieces(name):
    law = law_of(name)
    for segment in law.segments:
        pieces = segment.document().get("pieces", [{}])
        breaks = segment.start_time + np.cumsum([piece.get("duration") for piece in pieces[:-1]])
        for order in ORDERS:
            inner = segment.breaks[1:-1]
            for side in ("left", "right"):
                np.testing.assert_allclose(
                    law(breaks, order, side), segment(inner, order, side), rtol=1e-14, atol=0
                )


def brief_law(start_time):
    """Three pieces of one leg, of which the middle one takes 1e-8 s, from rest to rest after a dwell."""
    h, brief, rate = 1.0, 1e-8, 2.0
    middle = rate * h
    pieces = [
        {"duration": h, "state": [0.0, 0.0], "bernstein": [rate, rate]},
        {"duration": brief, "state": [middle * h / 2, middle], "bernstein": [rate, -rate]},
        {"duration": h, "state": [middle * h / 2 + middle * brief, middle], "bernstein": [-rate, -rate]},
    ]
    angle = middle * h + middle * brief
    duration = 2 * h + brief
    return from_document({
        "format": "timelaw-law", "version": 2, "name": "brief", "duration": start_time + duration,
        "conventions": {"quaternion": "wxyz, Hamilton, active, body to world", "rates": "body axes", "units": "rad, s"},
        "limits": {"velocity": 10.0},
        "segments": [
            {"kind": "dwell", "at": "a", "start_time": 0.0, "duration": start_time, "orientation": [1.0, 0.0, 0.0, 0.0]},
            {"kind": "arc", "from": "a", "to": "b", "start_time": start_time, "duration": duration, "start": [1.0, 0.0, 0.0, 0.0],
             "end": [float(np.cos(angle / 2)), 0.0, 0.0, float(np.sin(angle / 2))], "axis": [0.0, 0.0, 1.0], "angle": angle, "pieces": pieces},
        ],
    })  # fmt: skip


@pytest.mark.parametrize("start_time", [1e-3, 1.0, 1e6])
def test_brief_pieces_and_late_instants_are_as_exact_as_their_times(start_time):
    """α goes from 2 to -2 within 1e-8 s: what an instant cannot tell, no value can."""
    law = brief_law(start_time)
    break_time = law.segments[1].start_time + 1.0
    times = break_time + np.linspace(-2e-8, 3e-8, 41)
    motion = Motion(to_document(law))
    resolved = 4 * np.spacing(break_time)
    for order, next_largest in ((0, 1.0), (1, 2.0), (2, 4e8)):
        found = law(times, order)
        wanted = [[float(arb(x)) for x in evaluate_exactly(motion, 1, t)[order]] for t in times.tolist()]
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-14 + next_largest * resolved)


def test_memory_is_the_result_and_one_block():
    law, count = law_of("paper"), 400_000
    times = np.linspace(0, law.duration, count)
    law.evaluate(times[:10], (0, 1))
    tracemalloc.start()
    values = law.evaluate(times, (0, 1))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    result = sum(value.nbytes for value in values)
    assert peak - result <= 12 * evaluation.BLOCK * 8 + evaluation.CUT


def test_shapes_and_what_is_refused():
    law = law_of("dwells")
    q, omega = law.evaluate(np.zeros((2, 0, 3)), (0, 1))
    assert q.shape == (2, 0, 3, 4)
    assert omega.shape == (2, 0, 3, 3)
    assert [value.shape for value in law.evaluate(1.0, (2, 0, 2))] == [(3,), (4,), (3,)]
    times = np.linspace(0, law.duration, 100_000)
    np.testing.assert_array_equal(law(times[::-1]), law(times)[::-1])
    for wrong in (np.nan, -1e-9, law.duration * (1 + 1e-15)):
        times[77_777] = wrong
        with pytest.raises(ValueError, match="time outside"):
            law.evaluate(times, (0,))
    with pytest.raises(ValueError, match="order -1"):
        law.evaluate(0.0, (0, -1))


def test_every_kind_of_segment_has_its_stack():
    assert STACKS.keys() == KINDS.keys()


@pytest.mark.parametrize("degree", [0, 1, 5, 9, 24, 68])
def test_control_points_as_chebyshev_series(degree):
    """B_j at the ends and the middle, and the area below it, from the series."""
    matrix, k = expand_basis(degree), np.arange(degree + 1)
    np.testing.assert_allclose((-1.0) ** k @ matrix, np.eye(degree + 1)[0], atol=1e-14)
    np.testing.assert_allclose(np.ones(degree + 1) @ matrix, np.eye(degree + 1)[-1], atol=1e-14)
    binomials = [comb(degree, j) / 2.0**degree for j in k]
    np.testing.assert_allclose(np.cos(k * np.pi / 2) @ matrix, binomials, atol=1e-14)
    areas = np.array([0.0 if i % 2 else 1 / (1 - i * i) for i in k.tolist()])
    np.testing.assert_allclose(areas @ matrix, 1 / (degree + 1), atol=1e-14)
