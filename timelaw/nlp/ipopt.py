"""IPOPT through CasADi, quiet, with its verdict in our words."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np

from timelaw.interrupts import check_interrupted, find_interrupt, shield
from timelaw.nlp.assembly import Layout, assemble
from timelaw.nlp.program import LARGE
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
KEPT = 64  # solvers of small programs; one takes some hundred kilobytes


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

    def __init__(self, program: Any) -> None:
        super().__init__()
        n, parameters, rows = program.size1_in(0), program.size1_in(1), program.size1_out(1)
        self.sizes = {"f": 1, "x": n, "lam_x": n, "g": rows, "lam_g": rows, "lam_p": parameters}
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
        """A column of each."""
        size = self.sizes.get(ca.nlpsol_out(index), 0)
        return ca.Sparsity.dense(size) if size else ca.Sparsity(0, 0)

    def eval(self, _: Sequence[Any]) -> list[int]:
        """1 to stop."""
        count_steps()
        return [int(is_late() or find_interrupt() is not None)]


class Solver:
    """IPOPT for all programs of one layout."""

    def __init__(self, layout: Layout, *, strict: bool) -> None:
        program, derivatives = assemble(layout)
        self._stop = _Stop(program)  # CasADi does not keep it alive
        options = OPTIONS | derivatives | {"iteration_callback": self._stop} | (STRICT if strict else {})
        self._solver = ca.nlpsol("program", "ipopt", program, options)

    def __call__(self, start: Array, numbers: dict[str, Array]) -> tuple[Array, str, int]:
        """Where it stopped, its word for it, and iterations."""
        result = self._solver(x0=start, **numbers)
        status = self._solver.stats()
        return np.array(result["x"]).ravel(), status["return_status"], int(status["iter_count"])


@lru_cache(maxsize=KEPT)
def keep_solver(layout: Layout, *, strict: bool) -> Solver:
    """The solver of a small program, made once for all of its layout."""
    return Solver(layout, strict=strict)


def solve(layout: Layout, start: Array, numbers: dict[str, Array], *, strict: bool) -> Outcome:
    """Minimise f under lbg ≤ g ≤ ubg and lbx ≤ x ≤ ubx from `start` (n,); `strict` bounds are not relaxed.

    `numbers` are the bounds and the parameters p.

    Raises:
        Interrupted: a signal came, which CasADi keeps to itself and takes for a failure.
    """
    start = np.clip(start, numbers["lbx"], numbers["ubx"])
    if is_late():
        return Outcome(start, Verdict.STOPPED, 0)
    with shield():
        small = layout.variables <= LARGE
        solver = keep_solver(layout, strict=strict) if small else Solver(layout, strict=strict)
        check_interrupted()
        if is_late():  # construction takes long where there are thousands of legs
            return Outcome(start, Verdict.STOPPED, 0)
        x, word, iterations = solver(start, numbers)
    verdict = read_verdict(word)
    if verdict is Verdict.STOPPED and not is_late():
        raise KeyboardInterrupt  # of a caller who has a handler of his own, or Python's
    return Outcome(x, verdict, iterations)
