"""Seeded times: durations, arrivals, totals, and rates at the ends, about what is just possible."""

import numpy as np

from tests.campaign import least
from tests.campaign.legs import Leg, lay, loosest, runs
from tests.campaign.settings import RATE_UNITS, quantity
from tests.campaign.spec import Spec

FACTORS = (0.3, 0.9, 0.999, 1 - 1e-9, 1.0, 1 + 1e-9, 1.000001, 1.001, 1.02, 1.1, 1.5, 3.0, 30.0)


def _time(value: float) -> str:
    return f"{min(max(float(value), 2e-9), 9e8)!r} s"


def known_legs(spec: Spec) -> list[Leg]:
    """The legs, where the order is given and the orientations stand in the file; none elsewhere."""
    if not spec.points or spec.searched:
        return []
    labels = list(spec.points) if spec.tour == "given" else spec.tour
    return lay(spec, [*labels, labels[0]] if spec.closed else labels, spec.points)


def leg_times(spec: Spec, legs: list[Leg]) -> list[float]:
    """For each leg the least time between stops if plain rates say all, else that of the smoothstep."""
    found = []
    for leg in legs:
        w, a, j, s = leg.ceiling.rates
        if leg.ceiling.whole and s == np.inf:
            found.append(least.double_s(leg.angle, w, a, j))
        else:
            found.append(least.smoothstep_time(leg.angle, spec.continuity, leg.sets, spec.body, leg.axis))
    return found


def total(spec: Spec, legs: list[Leg]) -> float:
    """Least time of the whole by the closed form over the runs, dwells included."""
    labels = [legs[0].origin, *(leg.target for leg in legs)]
    rest = sum(spec.dwell(label, i, len(labels)) for i, label in enumerate(labels))
    return rest + sum(
        least.double_s(sum(leg.angle for leg in run), *loosest(run)[:3])
        for run in runs(spec, legs, merge=True)
    )


def durations(rng, spec: Spec, legs: list[Leg]) -> dict:
    """For one leg or several, from too short to long."""
    times = leg_times(spec, legs)
    generous = rng.random() < 0.5
    rules = {}
    for leg, time in zip(legs, times, strict=True):
        if rng.random() < 0.6 or not rules:
            factor = rng.uniform(2.5, 6) if generous else rng.choice(FACTORS)
            rules[f"{leg.origin}-{leg.target}"] = {"duration": _time(time * factor)}
    return rules


def arrivals(rng, spec: Spec, legs: list[Leg]) -> dict:
    """At one node or several, from too early to late, now and then running backwards."""
    passed, rules = 0.0, {}
    generous = rng.random() < 0.4
    labels = [leg.target for leg in legs]
    for k, (leg, time) in enumerate(zip(legs, leg_times(spec, legs), strict=True)):
        passed += time * (rng.uniform(2.5, 6) if generous else 1.0) + spec.dwell(leg.origin, k, len(legs) + 1)
        last = k == len(legs) - 1
        if (
            (rng.random() < 0.5 or (last and not rules))
            and labels.count(leg.target) == 1
            and leg.target != legs[0].origin
        ):
            factor = 1.0 if generous else float(rng.choice([*FACTORS, 0.1]))
            rules[leg.target] = {"time": _time(passed * factor)}
    return rules


def total_time(rng, spec: Spec, legs: list[Leg]) -> str:
    """Of the whole, in s or relative."""
    if not legs or rng.random() < 0.4:
        return str(
            rng.choice(
                ["1.0 x minimum", "1.5 x minimum", "1.000001 x minimum", "1.01 x minimum", "3 x minimum"]
            )
        )
    return _time(total(spec, legs) * float(rng.choice(FACTORS)))


def end_rates(rng, spec: Spec, legs: list[Leg]) -> dict:
    """Moving starts and ends: inside, exactly at, and above the limit; steady turns."""
    found, shares = {}, (0.05, 0.3, 0.7, 0.99, 1 - 1e-9, 1.0, 1.001, 1.2)
    steady = rng.random() < 0.25
    for which, leg in (("start", legs[0]), ("end", legs[-1])):
        if not steady and rng.random() < 0.4 and found:
            continue
        w, a, *_ = leg.ceiling.rates
        speed = w if w < np.inf else float(np.sqrt(leg.angle * min(a, 1e9)))
        share = 1.0 if steady else float(rng.choice(shares))
        exact = (
            f"{float(speed * share)!r} rad/s"
            if share > 0.98
            else quantity(rng, speed * share, RATE_UNITS["velocity"])
        )
        found[which] = {"velocity": exact}
        if not steady and spec.continuity >= 2 and a < np.inf and rng.random() < 0.3:
            found[which]["acceleration"] = quantity(
                rng, a * float(rng.choice([-1.0, -0.4, 0.2, 1.0])), "/s^2"
            )
    return found
