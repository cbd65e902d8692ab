"""The curves a problem file gives: signs chosen, ends that meet, quaternions that do not vanish."""

from itertools import pairwise

import numpy as np

from timelaw.bezier.curve import Curve
from timelaw.errors import Fault, InputError
from timelaw.numerics.array import Array
from timelaw.numerics.bernstein import evaluate
from timelaw.numerics.quaternion import angle_between
from timelaw.numerics.turn import SAME_ORIENTATION
from timelaw.orientations.forms import Writing, find_fault, make_quaternions
from timelaw.problem import Problem
from timelaw.problem.bezier import BezierModel

SIGNED = ("wxyz", "xyzw")  # forms that say which of q and -q is meant
RIGHT_ANGLE = 1e-9  # q·p within which neither sign is the nearer one: the form's own counts
SAME_PLACE = 1e-6  # of the farthest control point; ends nearer than that are one
LEAST_SQUARE = 1e-4  # of the largest |Q|²; where it is smaller, the curve runs through no orientation
POINTS = 1001


def read_curves(problem: Problem) -> tuple[Curve, ...]:
    """Curves between nodes 1, 2, …; each begins where the one before it ends.

    Quaternions keep the signs they are given with, other forms get the sign that is nearer to the one before;
    a curve that begins at minus the one before is taken with the other sign throughout.

    Raises:
        InputError: a row is wrong, curves do not meet, or a quaternion vanishes.
    """
    curves: list[Curve] = []
    for index, model in enumerate(problem.route.bezier or ()):
        where = f"route.bezier[{index + 1}]"
        control = _read_control(model, where)
        points = None if model.points is None else np.array(model.points)
        curve = Curve(str(index + 1), str(index + 2), control, points, model.translation == "divided")
        _refuse_vanishing(curve, where)
        curves.append(_join(curves[-1], curve, where) if curves else curve)
    return tuple(curves)


def _read_control(model: BezierModel, where: str) -> Array:
    """Unit quaternions (n+1, 4)."""
    writing = Writing(model.form or "wxyz", model.sequence or "ZXZ", model.unit or "rad")
    for index, row in enumerate(model.quaternions):
        wrong = find_fault(row, writing)
        if wrong:
            raise InputError(Fault(wrong, f"{where}.quaternions[{index + 1}]"))
    control = make_quaternions(model.quaternions, writing)
    if writing.form not in SIGNED:
        for before, after in pairwise(control):
            if before @ after < -RIGHT_ANGLE:
                after *= -1.0
    return control if model.weights is None else control * np.array(model.weights)[:, None]


def _refuse_vanishing(curve: Curve, where: str) -> None:
    u = np.linspace(0.0, 1.0, POINTS)
    square = evaluate(curve.square, u)
    if np.min(square) < LEAST_SQUARE * np.max(square):
        place = u[np.argmin(square)]
        message = (
            f"the quaternion of the curve nearly vanishes at u = {place:.3g}, where it has no orientation; "
            "its control quaternions lie on opposite sides: change a sign or put one between"
        )
        raise InputError(Fault(message, f"{where}.quaternions"))


def _join(before: Curve, curve: Curve, where: str) -> Curve:
    """The curve as it begins exactly where the one before it ends."""
    control, points = curve.control.copy(), curve.points
    there = before.control[-1]
    gap = float(angle_between(there, control[0]))
    if gap > SAME_ORIENTATION:
        message = f"begins {np.degrees(gap):.6g}° from where the curve before it ends"
        raise InputError(Fault(message, f"{where}.quaternions[1]"))
    control *= 1.0 if there @ control[0] > 0 else -1.0
    size, length = float(np.linalg.norm(control[0])), float(np.linalg.norm(there))
    control[0] = there if size == length else there * (size / length)
    if before.points is not None and points is not None:
        end, start = before.place(np.array([1.0]), 0)[0][0], curve.place(np.array([0.0]), 0)[0][0]
        farthest = float(max(np.max(np.abs(before.points)), np.max(np.abs(points))))
        distance = float(np.linalg.norm(end - start))
        if distance > SAME_PLACE * farthest:
            message = f"begins {distance:.6g} m from where the curve before it ends"
            raise InputError(Fault(message, f"{where}.points[1]"))
        weight = control[0] @ control[0] if curve.divided else 1.0
        points = np.concatenate([end[None] * weight, points[1:]])
    return Curve(curve.origin, curve.target, control, points, curve.divided)
