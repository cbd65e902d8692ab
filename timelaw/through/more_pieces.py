"""From one piece a leg to more: nearly the same path, with more to choose."""

from dataclasses import replace

import numpy as np

from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import basis_matrix
from timelaw.numerics.quaternion import multiply, normalise
from timelaw.through.curve import Curve, make_curve
from timelaw.through.dual import stack
from timelaw.through.kinematics import list_rates, make_basis

SAMPLES = 21  # of a piece, at which the inner points are fitted


def split(curve: Curve, pieces: int) -> Curve:
    """A curve of fewer pieces a leg in so many; not quite the same: of constant norm at the new knots too."""
    points = curve.control()
    place = np.arange(1, pieces) / pieces * curve.pieces
    piece = np.minimum(place.astype(int), curve.pieces - 1)
    turns, rates = [], []
    for own, u in zip(piece, place - piece, strict=True):
        basis = make_basis(curve.degree, np.array([u]), curve.smooth)
        states = np.einsum("mko,poc->kcpm", basis, points[own :: curve.pieces])
        turns.append(normalise(np.moveaxis(states[0, :, :, 0], 0, -1)))
        found = [stack(list(vector))[:, 0] for vector in list_rates(states).values()]
        rates.append(
            np.stack([rate / curve.duration[:, None] ** k for k, rate in enumerate(found, 1)], axis=1)
        )
    nodes = slice(None, None, curve.pieces)
    turn = _interleave(curve.turn[nodes], turns)
    made = make_curve(
        curve.degree,
        pieces,
        turn,
        _interleave(curve.rates[nodes], rates),
        curve.duration * curve.pieces / pieces,
    )
    return _fit(made, curve) if made.inner.shape[1] else made


def _interleave(nodes: Array, between: list[Array]) -> Array:
    """Values at nodes (K+1, ...) and between them (K, ...) in order."""
    inner = [np.expand_dims(value, 1) for value in (nodes[:-1], *between)]
    return np.concatenate([np.concatenate(inner, axis=1).reshape(-1, *nodes.shape[1:]), nodes[-1:]])


def _fit(curve: Curve, source: Curve) -> Curve:
    """Weight and inner points by least squares, so that Q is along the source's at samples of each piece.

    What of Q is at right angles to the source there is linear in them.
    """
    d, u = curve.degree, np.linspace(0.0, 1.0, SAMPLES)[1:-1]
    own = slice(curve.smooth + 1, d - curve.smooth)
    basis, points = basis_matrix(d, u), source.control()
    fixed = curve.control()
    fixed[:, own] = 0.0
    weight, inner = curve.weight.copy(), curve.inner.copy()
    for k in range(len(weight)):
        leg, part = divmod(k, curve.pieces)
        there = (u + part) / curve.pieces * source.pieces
        piece = np.minimum(there.astype(int), source.pieces - 1)
        near = points[leg * source.pieces + piece]
        aim = normalise(np.einsum("mo,moc->mc", basis_matrix(source.degree, there - piece), near))
        across = np.eye(4) - aim[:, :, None] * aim[:, None, :]
        units = multiply(curve.middle[k], np.eye(4))
        moving = basis[:, own]
        columns = [moving.sum(axis=1)[:, None] * units[0]]
        columns += [moving[:, i, None] * units[c] for i in range(moving.shape[1]) for c in (1, 2, 3)]
        matrix = np.stack([np.einsum("mij,mj->mi", across, column).ravel() for column in columns], axis=1)
        right = -np.einsum("mij,mj->mi", across, basis @ fixed[k]).ravel()
        found = np.linalg.lstsq(matrix, right, rcond=None)[0]
        weight[k], inner[k] = found[0] - 1, found[1:].reshape(-1, 3)
    return replace(curve, weight=weight, inner=inner)
