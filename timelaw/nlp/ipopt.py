"""IPOPT through CasADi, quiet, with its verdict in our words."""

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

OPTIONS: dict[str, Any] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    "ipopt.acceptable_tol": 1e-6,
    "ipopt.max_iter": 300,
    "ipopt.mu_strategy": "adaptive",
}
LEAST_DURATION = 1e-3  # in units of the start's mean duration; no limit lets a leg be that much faster


@dataclass(frozen=True)
class Outcome:
    """Where IPOPT stopped. `solved` and `acceptable` are its own claims, not evidence."""

    x: Array
    solved: bool
    acceptable: bool
    iterations: int


def solve(program: dict[str, Any], start: Array, durations: int) -> Outcome:
    """Minimise under -1 ≤ g ≤ 1 from `start` (n,); the first `durations` variables stay positive."""
    solver = ca.nlpsol("run", "ipopt", program, OPTIONS)
    lower = np.full(len(start), -np.inf)
    lower[:durations] = LEAST_DURATION
    result = solver(x0=start, lbx=lower, lbg=-1.0, ubg=1.0)
    status = solver.stats()
    x = np.array(result["x"]).ravel()
    text = status["return_status"]
    return Outcome(
        x,
        solved=text == "Solve_Succeeded",
        acceptable=text in ("Solve_Succeeded", "Solved_To_Acceptable_Level"),
        iterations=int(status["iter_count"]),
    )
