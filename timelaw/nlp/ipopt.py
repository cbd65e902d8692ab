"""IPOPT through CasADi, quiet, with its verdict in our words."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from timelaw.interrupts import check_interrupted, find_interrupt, shield
from timelaw.nlp.verdicts import Verdict, read_verdict
from timelaw.numerics.array import Array
from timelaw.progress import count_steps
from timelaw.time_limit import is_late

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
    """Where IPOPT stopped, and why. Its verdict is its own claim, not evidence."""

    x: Array
    verdict: Verdict
    iterations: int

    @property
    def solved(self) -> bool:
        """To its full tolerance, it says."""
        return self.verdict is Verdict.SOLVED

    @property
    def acceptable(self) -> bool:
        """To its full tolerance or its acceptable one."""
        return self.verdict.acceptable

    @property
    def stopped(self) -> bool:
        """Broken off because the time was over."""
        return self.verdict is Verdict.STOPPED


class _Stop(ca.Callback):
    """Asked by IPOPT after every iteration, with all it knows, whether to stop."""

    def __init__(self, variables: int, rows: int) -> None:
        super().__init__()
        self.sizes = {"f": 1, "x": variables, "lam_x": variables, "g": rows, "lam_g": rows}
        self.construct("stop", {})

    def get_n_in(self) -> int:
        """As many as results of a solver."""
        return int(ca.nlpsol_n_out())

    def get_n_out(self) -> int:
        """The answer."""
        return 1

    def get_name_in(self, index: int) -> str:
        """As results of a solver are called."""
        return str(ca.nlpsol_out(index))

    def get_sparsity_in(self, index: int) -> Any:
        """A column of each; there are no parameters."""
        size = self.sizes.get(ca.nlpsol_out(index), 0)
        return ca.Sparsity.dense(size) if size else ca.Sparsity(0, 0)

    def eval(self, _: Sequence[Any]) -> list[int]:
        """1 to stop."""
        count_steps()
        return [int(is_late() or find_interrupt() is not None)]


def solve(symbols: dict[str, Any], start: Array, bounds: dict[str, Array], *, strict: bool) -> Outcome:
    """Minimise f under lbg ≤ g ≤ ubg and lbx ≤ x ≤ ubx from `start` (n,); `strict` bounds are not relaxed.

    Raises:
        Interrupted: a signal came, which CasADi keeps to itself and takes for a failure.
    """
    start = np.clip(start, bounds["lbx"], bounds["ubx"])
    if is_late():
        return Outcome(start, Verdict.STOPPED, 0)
    with shield():
        stop = _Stop(len(bounds["lbx"]), len(bounds["lbg"]))
        options = OPTIONS | {"iteration_callback": stop} | (STRICT if strict else {})
        solver = ca.nlpsol("program", "ipopt", symbols, options)
        check_interrupted()
        if is_late():  # construction takes seconds where there are hundreds of legs
            return Outcome(start, Verdict.STOPPED, 0)
        result = solver(x0=start, **bounds)
        status = solver.stats()
        x = np.array(result["x"]).ravel()
    verdict = read_verdict(status["return_status"])
    if verdict is Verdict.STOPPED and not is_late():
        raise KeyboardInterrupt  # of a caller who has a handler of his own, or Python's
    return Outcome(x, verdict, int(status["iter_count"]))
