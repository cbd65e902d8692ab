"""Random sets of orientations of many kinds under random limits, to try a motion through the nodes on."""

from collections.abc import Callable
from typing import Any

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.quaternion import from_axis_angle, multiply, normalise

LEAST_NODES, MOST_NODES = 5, 30
DECADES = 4.0  # over which velocity limits are spread
RAMP = (0.03, 3.0)  # how long velocity takes to build up, in times of a turn at the limit; jerk likewise
TINY = (0.1, 3.0)  # deg
SMALL = (1.0, 10.0)  # deg
TINY_PART = 0.3  # of the legs of a set that has tiny ones


def _random(rng: np.random.Generator, count: int) -> Array:
    return normalise(rng.normal(size=(count, 4)))


def _nearest(rng: np.random.Generator, count: int) -> Array:
    """Each next one the nearest that is left."""
    left = list(_random(rng, count))
    order = [left.pop(0)]
    while left:
        order.append(left.pop(int(np.argmax([abs(float(q @ order[-1])) for q in left]))))
    return np.array(order)


def _chain(rng: np.random.Generator, angles: Array) -> Array:
    """By turns of these angles [deg] about random axes."""
    turns = from_axis_angle(normalise(rng.normal(size=(len(angles), 3))), np.radians(angles))
    found = [_random(rng, 1)[0]]
    for turn in turns:
        found.append(multiply(found[-1], turn))
    return normalise(np.array(found))


def _half_turns(rng: np.random.Generator, count: int) -> Array:
    """Every third leg is half a turn."""
    angles = rng.uniform(20.0, 170.0, count - 1)
    angles[::3] = 180.0
    return _chain(rng, angles)


def _small(rng: np.random.Generator, count: int) -> Array:
    return _chain(rng, rng.uniform(*SMALL, count - 1))


def _tiny(rng: np.random.Generator, count: int) -> Array:
    """Tiny legs among large ones."""
    angles = rng.uniform(20.0, 170.0, count - 1)
    chosen = rng.random(count - 1) < TINY_PART
    chosen[rng.integers(count - 1)] = True
    angles[chosen] = rng.uniform(*TINY, np.count_nonzero(chosen))
    return _chain(rng, angles)


KINDS: dict[str, Callable[[np.random.Generator, int], Array]] = {
    "random order": _random,
    "nearest order": _nearest,
    "half-turns": _half_turns,
    "small legs": _small,
    "tiny legs among large ones": _tiny,
}


def draw_problem(seed: int, number: int) -> tuple[str, dict[str, Any]]:
    """The kind of the `number`-th set of a seed, and the data of its problem file."""
    rng = np.random.default_rng([seed, number])
    kind = list(KINDS)[number % len(KINDS)]
    nodes = KINDS[kind](rng, int(rng.integers(LEAST_NODES, MOST_NODES + 1)))
    velocity = 10 ** rng.uniform(-DECADES / 2, DECADES / 2) * 10.0  # deg/s
    ramp, onset = np.exp(rng.uniform(np.log(RAMP[0]), np.log(RAMP[1]), 2)) * 60.0 / velocity
    return kind, {
        "timelaw": 1,
        "name": f"set-{seed}-{number}",
        "route": {"orientations": {"list": nodes.tolist(), "precision": "1e-9 deg"}},
        "motion": "through",
        "limits": {
            "velocity": f"{velocity:.6g} deg/s",
            "acceleration": f"{velocity / ramp:.6g} deg/s^2",
            "jerk": f"{velocity / ramp / onset:.6g} deg/s^3",
        },
        "baselines": [],
    }


def draw_large(seed: int, count: int = 1000) -> dict[str, Any]:
    """The data of a problem with many random orientations, each next one the nearest that is left."""
    nodes = _nearest(np.random.default_rng([seed, count]), count)
    _, data = draw_problem(seed, 0)
    data["name"] = f"set-{seed}-of-{count}"
    data["route"] = {"orientations": {"list": nodes.tolist(), "precision": "1e-9 deg"}}
    data["limits"] = {"velocity": "60 deg/s", "acceleration": "120 deg/s^2", "jerk": "600 deg/s^3"}
    data["motion"] = {"kind": "through", "pieces": 1}
    return data
