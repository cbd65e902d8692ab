"""IPOPT through CasADi, quiet, with its verdict in our words."""

from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from timelaw.numerics.array import Array

OPTIONS: dict[str, Any] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.tol": 1e-9,
    "ipopt.acceptable_tol": 1e-6,
    "ipopt.max_iter": 300,
    "ipopt.mu_strategy": "adaptive",
    "ipopt.fixed_variable_treatment": "make_parameter",
}
STRICT: dict[str, Any] = {"ipopt.bound_relax_factor": 0.0}


@dataclass(frozen=True)
class Outcome:
    """Where IPOPT stopped. `solved` and `acceptable` are its own claims, not evidence."""

    x: Array
    solved: bool
    acceptable: bool
    iterations: int


def solve(symbols: dict[str, Any], start: Array, bounds: dict[str, Array], *, strict: bool) -> Outcome:
    """Minimise f under lbg ≤ g ≤ ubg and lbx ≤ x ≤ ubx from `start` (n,); `strict` bounds are not relaxed."""
    solver = ca.nlpsol("program", "ipopt", symbols, OPTIONS | (STRICT if strict else {}))
    result = solver(x0=np.clip(start, bounds["lbx"], bounds["ubx"]), **bounds)
    status = solver.stats()
    text = status["return_status"]
    if text == "User_Requested_Stop":  # CasADi takes the interrupt from Python
        raise KeyboardInterrupt
    return Outcome(
        np.array(result["x"]).ravel(),
        solved=text == "Solve_Succeeded",
        acceptable=text in ("Solve_Succeeded", "Solved_To_Acceptable_Level"),
        iterations=int(status["iter_count"]),
    )
