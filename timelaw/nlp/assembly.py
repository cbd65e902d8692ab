"""The nonlinear program and its derivatives, put together from kernels that are mapped over their points.

Nothing is differentiated here: sparse Jacobian and Hessian are the kernels' own entries, brought to their
places. So a program of a thousand legs is built in little more time than that of one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from timelaw.interrupts import check_interrupted
from timelaw.nlp.kernel import Kernel, repeat_kernel

Indices = NDArray[np.int64]
UNDIFFERENTIATED = {"no_nlp_grad": True, "calc_lam_p": False}


@dataclass(frozen=True)
class Block:
    """A kernel at `points` times `members` points; the points of a member share the `variables` z.

    `variables` lists the variables of one member after the other.
    """

    kernel: Kernel
    points: int
    variables: tuple[int, ...]

    @property
    def members(self) -> int:
        """How many."""
        return len(self.variables) // self.kernel.variables

    @property
    def size(self) -> int:
        """Points of all members."""
        return self.points * self.members

    @property
    def indices(self) -> Indices:
        """The variables (members, z)."""
        return np.array(self.variables, dtype=np.int64).reshape(-1, self.kernel.variables)


@dataclass(frozen=True)
class Layout:
    """All that numbers do not change: `cost`·x + Σ of the efforts, under rows, and sums of first variables.

    Parameters are the cost (n,), those of the rows' points and of the efforts', and the weights of the sums.
    """

    variables: int
    rows: tuple[Block, ...]
    efforts: tuple[Block, ...]
    sums: tuple[int, ...]

    @property
    def parameters(self) -> int:
        """How many."""
        blocks = (*self.rows, *self.efforts)
        return self.variables + sum(b.size * b.kernel.parameters for b in blocks) + sum(self.sums)


def assemble(layout: Layout) -> tuple[Any, dict[str, Any]]:
    """The program as a function of x and p, and its derivatives as options of CasADi's solvers."""
    n, blocks = layout.variables, (*layout.rows, *layout.efforts)
    x, p = ca.MX.sym("x", n), ca.MX.sym("p", layout.parameters)
    sizes = [n, *(b.size * b.kernel.parameters for b in blocks), *layout.sums]
    cost, *given = ca.vertsplit(p, np.cumsum([0, *sizes]).tolist())
    places = [ca.reshape(x[list(block.variables)], block.kernel.variables, block.members) for block in blocks]
    numbers = [
        ca.reshape(part, block.kernel.parameters, block.size)
        for part, block in zip(given, blocks, strict=False)
    ]
    weights = given[len(blocks) :]
    count = sum(block.size for block in layout.rows)
    scale, factors = ca.MX.sym("lam_f"), ca.MX.sym("lam_g", count + len(layout.sums))
    values, slopes, curves = [], [], []
    multipliers = ca.vertsplit(
        factors, np.cumsum([0, *(b.size for b in layout.rows), len(layout.sums)]).tolist()
    )
    for k, (block, z, numbered) in enumerate(zip(blocks, places, numbers, strict=True)):
        check_interrupted()
        kernel = repeat_kernel(block.kernel, block.points)
        values.append(ca.vec(kernel.value.map(block.members)(z, numbered)))
        slopes.append(ca.vec(kernel.gradient.map(block.members)(z, numbered)))
        multiplier = multipliers[k].T if k < len(layout.rows) else ca.repmat(scale, 1, block.size)
        curves.append(ca.vec(kernel.hessian.map(block.members)(z, numbered, multiplier)))
    first = len(layout.rows)
    f = ca.dot(cost, x) + sum(ca.sum1(value) for value in values[first:])
    sums = [ca.dot(weight, x[:size]) for weight, size in zip(weights, layout.sums, strict=True)]
    g = ca.vertcat(*values[:first], *sums)
    gradient = cost
    if layout.efforts:
        gradient = gradient + _scatter(_slope_places(layout.efforts), n) @ ca.vertcat(*slopes[first:])
    jacobian = _jacobian(layout, ca.vertcat(*slopes[:first], *weights))
    hessian = _hessian(blocks, n, ca.vertcat(*curves)) if blocks else ca.MX(n, n)
    program = ca.Function("nlp", [x, p], [f, g], ["x", "p"], ["f", "g"])
    return program, UNDIFFERENTIATED | {
        "grad_f": ca.Function("nlp_grad_f", [x, p], [f, gradient]),
        "jac_g": ca.Function("nlp_jac_g", [x, p], [g, jacobian]),
        "hess_lag": ca.Function("nlp_hess_l", [x, p, scale, factors], [hessian]),
    }


def _slope_places(blocks: Sequence[Block]) -> Indices:
    """The variable of each entry of the blocks' gradients, point after point."""
    found = [np.zeros(0, dtype=np.int64)]
    for block in blocks:
        entries = list(repeat_kernel(block.kernel, block.points).entries)
        found.append(np.repeat(block.indices[:, entries], block.points, axis=0).ravel())
    return np.concatenate(found)


def _jacobian(layout: Layout, entries: Any) -> Any:
    """The rows' gradients as a sparse matrix; a row names no variable twice."""
    columns = [_slope_places(layout.rows), *(np.arange(size) for size in layout.sums)]
    widths = [
        np.full(block.size, len(repeat_kernel(block.kernel, block.points).entries)) for block in layout.rows
    ]
    each = np.concatenate([*widths, layout.sums]).astype(np.int64)
    rows = np.repeat(np.arange(len(each)), each)
    column = np.concatenate(columns)
    order = np.lexsort((rows, column))
    sparsity = _sparsity(len(each), layout.variables, rows[order], column[order])
    return ca.MX(sparsity, entries[order.tolist()])


def _hessian(blocks: Sequence[Block], n: int, entries: Any) -> Any:
    """The upper triangle, entries at one place added."""
    rows, columns = [], []
    for block in blocks:
        pairs = np.array(repeat_kernel(block.kernel, block.points).pairs, dtype=np.int64).reshape(-1, 2)
        one, two = block.indices[:, pairs[:, 0]].ravel(), block.indices[:, pairs[:, 1]].ravel()
        rows.append(np.minimum(one, two))
        columns.append(np.maximum(one, two))
    places = np.concatenate(columns) * n + np.concatenate(rows)
    known, at = np.unique(places, return_inverse=True)
    sparsity = _sparsity(n, n, known % n, known // n)
    return ca.MX(sparsity, _scatter(at.ravel(), len(known)) @ entries)


def _scatter(places: Indices, size: int) -> Any:
    """The constant matrix (size, m) that adds each of m entries to its place."""
    colind = np.arange(len(places) + 1)
    return ca.DM(ca.Sparsity(size, len(places), colind.tolist(), places.tolist()), 1.0)


def _sparsity(height: int, width: int, rows: Indices, columns: Indices) -> Any:
    """From entries sorted by column, then row."""
    colind = np.searchsorted(columns, np.arange(width + 1))
    return ca.Sparsity(height, width, colind.tolist(), rows.tolist())
