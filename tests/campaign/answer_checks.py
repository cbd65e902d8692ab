"""Checks of a law beside others: baselines, what no motion beats, closed forms, linear programs."""

from collections.abc import Iterator
from math import inf

import numpy as np

from tests.campaign import least, leg_program
from tests.campaign.bounds import demanded, used_parts
from tests.campaign.evidence import NODES, WEIGHTS, Evidence
from tests.campaign.leg_oracle import (
    has_closed_form,
    has_program,
    leg_factor,
    leg_time,
    linear,
    physical_time,
)
from tests.campaign.legs import Leg, alike, loosest, runs, sure

GAP = 2e-6  # relative: what the solver may leave, as documented
EQUAL = 1e-5  # law and linear program
CLOSED = {"double-s": 1e-9, "spline": 1e-6}
SHORT = 2e-5  # of a run: a phase of the double-S that the README says is not resolved
DOCUMENTED = {(4, 2): (50, 2e-3), (5, 3): (70, 3e-3)}  # spline degree, continuity: intervals, distance
MOST_PROGRAMS = 2  # distinct legs of a case that linear programs are solved for
EFFORTS = {"energy": 2, "jerk": 3, "snap": 4}
QUINTIC = (15 / 8, 10 / 3**0.5, 60.0)


def free(e: Evidence) -> bool:
    """Whether the time is made least and nothing but limits and dwells stands in its way."""
    return e.spec.objective["minimise"] == "time" and not e.spec.timed and not e.spec.moving


def parts(e: Evidence) -> Iterator[tuple[list[Leg], float]]:
    """Runs with the time the law takes for each."""
    place = 0
    for run in runs(e.spec, e.legs, merge=False):
        start, place = place, place + len(run)
        yield run, e.visits[place][0] - e.visits[start][1]


def nothing_is_faster_than_physics(e: Evidence) -> Iterator[str]:
    """Run by run, what is unsure counted as one run."""
    found = runs(e.spec, e.legs, merge=True)
    place = 0
    for number_of, run in enumerate(found):
        start, place = place, place + len(run)
        took = e.visits[place][0] - e.visits[start][1]
        still = (
            not (number_of == 0 and any(e.spec.end_rates("start"))),
            not (number_of == len(found) - 1 and any(e.spec.end_rates("end"))),
        )
        bound = physical_time(run) if all(still) else sum(leg.angle / leg.ceiling.rates[0] for leg in run)
        blur = 1e-9 + 4 * e.spec.precision / min(leg.angle for leg in run)
        if not took >= bound * (1 - blur):
            yield f"too fast: {run[0].origin}-{run[-1].target} in {took:.12g} s, physics allows {bound:.12g} s"


def quintic_is_no_faster(e: Evidence) -> Iterator[str]:
    """The law is not slower than the quintic from stop to stop."""
    for other in e.design.baselines:
        if other.name == "quintic" and free(e) and e.spec.continuity <= 2 and other.certificate.limits_hold:
            mine, its = float(e.law.times[-1]), float(other.law.times[-1])
            if not mine <= its * (1 + GAP):
                yield f"slower than the quintic: {mine:.9g} s, {its:.9g} s"


def baselines_are_right(e: Evidence) -> Iterator[str]:
    """Quintic and double-S take what their closed forms say."""
    plain = (
        free(e)
        and sure(e.spec, e.legs)
        and all(leg.ceiling.whole and leg.ceiling.rates[3] == inf for leg in e.legs)
    )
    if not plain or e.spec.precision:
        return
    rest = sum(left - arrived for arrived, left in e.visits)
    for other in e.design.baselines:
        found = float(other.law.times[-1]) - rest
        if other.name == "quintic":
            wanted, tolerance = sum(_quintic(leg) for leg in e.legs), 1e-9
        else:
            found_runs = (
                [[leg] for leg in e.legs] if "stop" in other.name else runs(e.spec, e.legs, merge=False)
            )
            if not all(alike(run) for run in found_runs):
                continue
            wanted = sum(physical_time(run) for run in found_runs)
            tolerance = max(_closed_tolerance(run, 1e-9) for run in found_runs)
        if not abs(found - wanted) <= wanted * tolerance:
            yield f"baseline {other.name}: {found:.12g} s, its closed form is {wanted:.12g} s"


def _quintic(leg: Leg) -> float:
    return max(
        (p * leg.angle / b) ** (1 / k)
        for k, (p, b) in enumerate(zip(QUINTIC, leg.ceiling.rates[:3], strict=True), 1)
    )


def _closed_tolerance(run: list[Leg], tolerance: float) -> float:
    angle, bounds = sum(leg.angle for leg in run), loosest(run)[:3]
    phases = [p for p in least.phase_times(angle, *bounds) if p > 0]
    return 5e-5 if min(phases) < 2 * SHORT * sum(phases) else tolerance


def closed_form_is_reached(e: Evidence) -> Iterator[str]:
    """Where the family holds the double-S, or is documented to come near it."""
    if not free(e) or not sure(e.spec, e.legs) or e.spec.precision:
        return
    for run, took in parts(e):
        wanted = physical_time(run)
        if has_closed_form(e.spec, run):
            tolerance = _closed_tolerance(run, CLOSED[e.spec.easing["basis"]])
        else:
            tolerance = _documented(e, run)
        if tolerance < inf and not took <= wanted * (1 + tolerance):
            yield f"not least: {run[0].origin}-{run[-1].target} in {took:.12g} s, the double-S takes {wanted:.12g} s"


def _documented(e: Evidence, run: list[Leg]) -> float:
    if e.spec.easing["basis"] != "spline" or len(run) > 1 or not alike(run) or loosest(run)[3] < inf:
        return inf
    intervals, distance = DOCUMENTED.get((e.spec.degree, e.spec.continuity), (inf, inf))
    whole = max(loosest(run)[:3]) < inf
    return distance if whole and e.spec.intervals >= intervals else inf


def linear_program_agrees(e: Evidence) -> Iterator[str]:
    """Legs that are runs of their own, a polynomial each: the global optimum."""
    if not free(e) or not sure(e.spec, e.legs) or e.spec.precision:
        return
    seen: set[float] = set()
    for run, took in parts(e):
        key = round(took / float(e.law.times[-1]), 6)
        if len(run) > 1 or not has_program(e.spec, run[0]) or key in seen or len(seen) == MOST_PROGRAMS:
            continue
        seen.add(key)
        lower, upper = leg_time(e.spec, run[0])
        if not lower * (1 - EQUAL) <= took <= upper * (1 + EQUAL):
            yield f"not least: {run[0].origin}-{run[0].target} in {took:.9g} s, a linear program {lower:.9g} to {upper:.9g} s"


def moving_leg_is_least(e: Evidence) -> Iterator[str]:
    """One leg between given rates: no linear program finds a law in much less time."""
    spec = e.spec
    if not spec.moving or spec.timed or len(e.legs) > 1 or not has_program(spec, e.legs[0]):
        return
    took = e.visits[1][0] - e.visits[0][1]
    leg = linear(e.legs[0], spec.end_rates("start"), spec.end_rates("end"))
    for share in (0.98, 0.9, 0.7, 0.5):
        if leg_program.least_factor(leg, took * share, leg_program.Space(spec.degree))[1] <= 1 - 1e-7:
            yield f"not least: {took:.9g} s between the given rates, a linear program holds the limits in {share} of it"
            return


def effort_of(e: Evidence, order: int) -> float:
    """∫ |k-th rate|² dt of the law."""
    total = 0.0
    for piece in e.pieces:
        rate = np.asarray(e.law(e.inside(piece, (NODES + 1) / 2), order))
        total += float(WEIGHTS / 2 @ np.sum(rate**2, axis=1)) * (piece.end - piece.start)
    return total


def effort_is_least(e: Evidence) -> Iterator[str]:
    """The closed form of least effort in a total time, where limits leave room for it, else more."""
    spec = e.spec
    order = EFFORTS.get(spec.objective["minimise"])
    alone = not spec.moving and not spec.legs and not any("time" in rule for rule in spec.nodes.values())
    if (
        order is None
        or "total_time" not in spec.objective
        or not alone
        or not sure(spec, e.legs)
        or spec.precision
    ):
        return
    found_runs = [run for run, _ in parts(e)]
    turns = [sum(leg.angle for leg in run) for run in found_runs]
    time = sum(took for _, took in parts(e))
    wanted, value = least.least_effort(order, order - 1, turns, time), effort_of(e, order)
    if not value >= wanted * (1 - 1e-6):
        yield f"effort: ∫ of {spec.objective['minimise']} is {value:.9g}, less than the least {wanted:.9g}"
    contained = spec.easing["basis"] == "polynomial" and spec.continuity == order - 1
    if contained and _smoothsteps_fit(e, order, found_runs, time) and not value <= wanted * (1 + 1e-4):
        yield f"effort: ∫ of {spec.objective['minimise']} is {value:.9g}, the least is {wanted:.9g}"


def _smoothsteps_fit(e: Evidence, order: int, found_runs, time: float) -> bool:
    """Whether the smoothsteps that make the effort least hold all limits."""
    share = 1 / order
    whole = sum(sum(leg.angle for leg in run) ** share for run in found_runs)
    shape = np.polynomial.Polynomial(least.smoothstep(order - 1))
    for run in found_runs:
        angle = sum(leg.angle for leg in run)
        own = time * angle**share / whole
        phi = {k: shape.deriv(k)(least.GRID) * angle / own**k for k in (1, 2, 3, 4)}
        if any(demanded(leg.sets, e.spec.body, leg.axis, phi) > 0.999 for leg in run):
            return False
    return True


def peak_is_least(e: Evidence) -> Iterator[str]:
    """One leg in a given time that uses the least part of its limits: as a linear program says."""
    one = e.spec.objective["minimise"] == "peak" and len(e.legs) == 1 and not e.spec.moving
    if not one or not has_program(e.spec, e.legs[0]) or e.spec.legs or e.spec.precision:
        return
    leg, spec = e.legs[0], e.spec
    used = max(
        float(np.max(v))
        for s in e.samples
        for limits in leg.sets
        for v in used_parts(limits, spec.body, s).values()
    )
    _, upper = leg_factor(spec, leg, e.visits[1][0] - e.visits[0][1])
    if not used <= upper * (1 + 1e-4):
        yield f"peak: {used:.9g} of the limits are used, {upper:.9g} suffices"


def total_is_a_multiple(e: Evidence) -> Iterator[str]:
    """A total of f x minimum is at least f times what physics allows."""
    if e.spec.stretch is None or e.spec.moving or e.spec.precision:
        return
    rest = sum(left - arrived for arrived, left in e.visits)
    bound = e.spec.stretch * (rest + sum(physical_time(run) for run in runs(e.spec, e.legs, merge=True)))
    if not float(e.law.times[-1]) >= bound * (1 - 1e-9):
        yield f"total time: {float(e.law.times[-1]):.9g} s is less than {e.spec.stretch} times the least"


ANSWER_CHECKS = (
    nothing_is_faster_than_physics,
    quintic_is_no_faster,
    baselines_are_right,
    closed_form_is_reached,
    linear_program_agrees,
    moving_leg_is_least,
    effort_is_least,
    peak_is_least,
    total_is_a_multiple,
)
