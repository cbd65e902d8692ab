"""More pieces for each leg: a curve cut where its pieces shall meet, nearly the same, to search on from."""

from dataclasses import replace

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix
from timelaw.numerics.quaternion import multiply, normalise
from timelaw.through.curve import Curve, make_curve
from timelaw.through.start import align_signs
from timelaw.through.turning_rows import make_basis, measure_rates

SAMPLES = 21  # of a piece, at which the inner points are fitted


def split(curve: Curve, pieces: int) -> Curve:
    """A curve of one piece a leg in so many; not quite the same: of constant norm at the new knots too."""
    cuts = make_basis(curve.degree, np.arange(1, pieces) / pieces)
    points = curve.control()
    rates = measure_rates(points, cuts)
    inner = [normalise(np.einsum("mo,poc->pmc", cuts[:, 0], points))]
    inner += [rates[:, :, k - 1] / curve.steps[:, None, None] ** k for k in (1, 2)]
    knots = [
        np.concatenate(
            [np.concatenate([own[:-1, None], between], axis=1).reshape(-1, own.shape[1]), own[-1:]]
        )
        for own, between in zip((curve.turn, curve.omega, curve.alpha), inner, strict=True)
    ]
    made = make_curve(
        curve.degree, pieces, align_signs(knots[0]), knots[1], knots[2], curve.duration / pieces
    )
    return _fit(made, points, pieces) if made.inner.shape[1] else made


def _fit(curve: Curve, points: Array, pieces: int) -> Curve:
    """Weight and inner points by least squares, so that Q is along the source's at samples of each piece.

    What of Q is at right angles to the source there is linear in them.
    """
    d, u = curve.degree, np.linspace(0.0, 1.0, SAMPLES)[1:-1]
    basis = basis_matrix(d, u)
    fixed = curve.control()
    fixed[:, 3:-3] = 0.0
    weight, inner = curve.weight.copy(), curve.inner.copy()
    for k in range(len(weight)):
        leg, part = divmod(k, pieces)
        aim = normalise(basis_matrix(d, (u + part) / pieces) @ points[leg])
        across = np.eye(4) - aim[:, :, None] * aim[:, None, :]
        units = multiply(curve.middle[k], np.eye(4))
        moving = basis[:, 3:-3]
        columns = [moving.sum(axis=1)[:, None] * units[0]]
        columns += [moving[:, i, None] * units[c] for i in range(moving.shape[1]) for c in (1, 2, 3)]
        matrix = np.stack([np.einsum("mij,mj->mi", across, column).ravel() for column in columns], axis=1)
        right = -np.einsum("mij,mj->mi", across, basis @ fixed[k]).ravel()
        found = np.linalg.lstsq(matrix, right, rcond=None)[0]
        weight[k], inner[k] = found[0] - 1, found[1:].reshape(-1, 3)
    return replace(curve, weight=weight, inner=inner)
