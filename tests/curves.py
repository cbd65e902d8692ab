"""Bézier curves for tests: problem texts, and an evaluation of their own by powers of u."""

from math import comb
from pathlib import Path

import numpy as np

from timelaw.bezier.read import read_curves
from timelaw.pipeline_bezier import design_curves
from timelaw.problem.load import check_problem
from timelaw.problem.source import read

RATES = "velocity: 60 deg/s, acceleration: 120 deg/s^2, jerk: 600 deg/s^3"
LINEAR = "linear_velocity: 2 m/s, linear_acceleration: 3 m/s^2"
RNG = np.random.default_rng(3)
TURNS = np.cumsum(np.concatenate([[[1.0, 0, 0, 0]], RNG.normal(size=(3, 4)) * 0.6]), axis=0)
TURNS /= np.linalg.norm(TURNS, axis=1)[:, None]
PLACES = np.cumsum(RNG.normal(size=(4, 3)), axis=0)


def split(control, u):
    """Both parts of a curve, by de Casteljau."""
    rows = np.array(control) * 1.0  # in the precision that is given
    left, right = [rows[0]], [rows[-1]]
    while len(rows) > 1:
        rows = (1 - u) * rows[:-1] + u * rows[1:]
        left.append(rows[0])
        right.append(rows[-1])
    return np.array(left), np.array(right[::-1])


def curve(control, points=None, translation="plain"):
    """A curve of a problem file, its control quaternions of any length."""
    weights = np.linalg.norm(control, axis=1)
    quaternions = (control / weights[:, None]).tolist()
    text = f"{{quaternions: {quaternions}, weights: {weights.tolist()}"
    if points is not None:
        rows = ", ".join(
            "[" + ", ".join(f"{x!r} m" for x in row) + "]" for row in np.asarray(points).tolist()
        )
        text += f", translation: {translation}, points: [{rows}]"
    return text + "}"


def problem_text(curves, limits=RATES, more=""):
    return (
        f"timelaw: 1\nname: curves\nroute: {{bezier: [{', '.join(curves)}]}}\nlimits: {{{limits}}}\n{more}\n"
    )


def make(curves, limits=RATES, more="baselines: []"):
    """The design of such a problem."""
    source = read(problem_text(curves, limits, more), "curves.yaml")
    return design_curves(Path("curves.yaml"), check_problem(source), source)


def read_given(curves):
    """The curves of such a problem, without a law."""
    return read_curves(check_problem(read(problem_text(curves), "curves.yaml")))


def evaluate(control, u):
    """Σ B_i(u) c_i by binomials, u (m,)."""
    u, n = np.asarray(u)[:, None], len(control) - 1
    return sum(comb(n, i) * u**i * (1 - u) ** (n - i) * np.asarray(control[i]) for i in range(n + 1))


def halves(u=0.3, projective=1.0, parts=(TURNS, PLACES)):
    """One curve cut in two; the second run through otherwise, where its weights are multiplied by powers."""
    left, right = split(parts[0], u)
    right = right * projective ** np.arange(len(right))[:, None]
    if parts[1] is None:
        return [curve(left), curve(right)]
    ways = split(parts[1], u)
    return [curve(left, ways[0]), curve(right, ways[1])]
