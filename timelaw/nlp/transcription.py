"""A run as a nonlinear program in CasADi: scaled variables, labelled rows.

Variables, all of order one: durations T_k in units of `unit`; at each straight node the rates
φ', φ'', …, φ^(r), in units of the mean angle over unit^i, shared by the legs on both sides, so
that continuity holds by construction; the free control points of each leg. Rows: limit rows of
the k-th derivative at chosen points τ, divided by the bound and written θ f^(k)/T^k ≤ bound
(with T^k on the other side IPOPT needs several times the iterations).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from timelaw.easing import Timing
from timelaw.nlp.run_problem import RunProblem
from timelaw.objectives import OBJECTIVES

Array = NDArray[np.float64]

Points = list[list[Array]]  # points[leg][limit]: where that limit is demanded on that leg


class RowLabel(NamedTuple):
    """What a row of the program demands: a limit, on a leg, at a point τ of it."""

    leg: int
    limit: str
    tau: float


@dataclass(frozen=True)
class Transcription:
    """The program, and the way from its variables back to timings."""

    problem: RunProblem
    unit: float
    program: dict[str, Any]
    labels: tuple[RowLabel, ...]
    unpack: Any

    def timings(self, x: Array) -> tuple[Timing, ...]:
        """Timings of the legs from the variables (n,) of a solution."""
        legs = len(self.problem.angles)
        columns = np.array(self.unpack(x))
        return tuple(
            Timing(float(columns[0, k]), self.problem.basis.easing(columns[1:, k])) for k in range(legs)
        )


def transcribe(problem: RunProblem, points: Points, unit: float) -> Transcription:
    """Build the program with limits demanded at the given points."""
    legs, basis = len(problem.angles), problem.basis
    scale = float(np.mean(problem.angles))
    sizes = [legs, basis.continuity * (legs - 1), basis.free * legs]
    variables = ca.MX.sym("x", sum(sizes))
    durations, speeds, free = ca.vertsplit(variables, [0, *np.cumsum(sizes).tolist()])
    speeds = ca.reshape(speeds, basis.continuity, legs - 1)
    free = ca.reshape(free, basis.free, legs)
    rest = ca.MX.zeros(basis.continuity)
    rows: list[Any] = []
    labels: list[RowLabel] = []
    columns: list[Any] = []
    for k, angle in enumerate(problem.angles):
        powers = ca.vertcat(*[durations[k] ** i * scale / angle for i in range(1, basis.continuity + 1)])
        before = ca.vertcat(0.0, speeds[:, k - 1] * powers if k else rest)
        after = ca.vertcat(1.0, speeds[:, k] * powers if k < legs - 1 else rest)
        control = basis.from_left @ before + basis.from_free @ free[:, k] + basis.from_right @ after
        columns.append(ca.vertcat(unit * durations[k], control))
        for limit, tau in zip(problem.limits, points[k], strict=True):
            rates = {
                order: angle / (unit * durations[k]) ** order * (ca.DM(basis.values(tau, order)) @ control)
                for order in limit.orders
            }
            for row in limit.rows(rates):
                rows.append(row.value / row.bound)
                labels += [RowLabel(k, row.label, float(t)) for t in tau]
    objective = OBJECTIVES[problem.objective](ca.vertsplit(durations))
    program = {"x": variables, "f": objective, "g": ca.vertcat(*rows)}
    unpack = ca.Function("unpack", [variables], [ca.horzcat(*columns)])
    return Transcription(problem, unit, program, tuple(labels), unpack)


def pack(problem: RunProblem, timings: Sequence[Timing], unit: float) -> Array:
    """Variables (n,) of given timings whose easings the basis contains."""
    scale = float(np.mean(problem.angles))
    r = problem.basis.continuity
    durations = [timing.duration / unit for timing in timings]
    speeds = [
        float(timing.easing(1.0, i, side="left")) * angle / (timing.duration / unit) ** i / scale
        for timing, angle in zip(timings[:-1], problem.angles, strict=False)
        for i in range(1, r + 1)
    ]
    free = [problem.basis.free_of(timing.easing) for timing in timings]
    return np.concatenate([durations, speeds, *free])
