"""The part of a problem file about Bézier motions: control quaternions, control points of the translation."""

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from timelaw.problem.fields import Model, as_tuple, fault, read_quantity
from timelaw.problem.forms import SEQUENCE, FormName, Numbers, refuse_half_form
from timelaw.units import LENGTH, MOST

if TYPE_CHECKING:
    from timelaw.problem.problem import Problem

LARGEST_DEGREE = 7  # of a curve; with an easing of degree 9 the law's pieces have degree 63
MOST_CURVES = 200
HEAVIEST = 1000.0  # weight of a control quaternion
BASES = ("polynomial", "spline")  # easings a curve may have
Point = tuple[float, float, float]


def _point(value: Any) -> Any:
    """Three lengths with their units; a plain 0 needs none."""
    if not isinstance(value, list) or len(value) != 3:
        raise fault("a point has three coordinates with their units, as in [-9 m, 6 m, 0.5 m]")
    return tuple(
        0.0 if v == 0 and not isinstance(v, bool) else read_quantity(v, LENGTH, -MOST) for v in value
    )


def _weights(value: Any) -> Any:
    """Positive numbers of moderate size."""
    good = isinstance(value, list) and all(
        isinstance(v, int | float) and not isinstance(v, bool) and 1 / HEAVIEST <= v <= HEAVIEST
        for v in value
    )
    if not good:
        raise fault(f"numbers from {1 / HEAVIEST:g} to {HEAVIEST:g} are needed, as in [1, 0.9, 0.9, 1]")
    return tuple(float(v) for v in value)


def _count(what: str, least: int) -> BeforeValidator:
    """So many of a list, no fewer than make a curve and no more than make a degree that is carried."""

    def check(value: Any) -> Any:
        if isinstance(value, list) and not least <= len(value) <= LARGEST_DEGREE + 1:
            raise fault(f"{len(value)} {what}; {least} to {LARGEST_DEGREE + 1} are needed")
        return as_tuple(value)

    return BeforeValidator(check)


class BezierModel(Model):
    """One curve: Q(u) = Σ B_i(u) Q_i, whose orientation is Q/|Q|, and the place of the body's origin.

    `as`, `unit` and `sequence` say how the control quaternions are written, as they do for orientations;
    `axis-angle` is [x, y, z, angle]. `translation: divided` puts the origin at Σ B_j P_j/|Q|² [HZ2019],
    `plain` at Σ B_j P_j; there may be other numbers of points than of quaternions. `weights` are lengths of
    the control quaternions, all 1 unless given: curves that are cut in two, or joined smoothly, need others.
    """

    quaternions: Annotated[tuple[Numbers, ...], _count("control quaternions", 2)]
    points: Annotated[
        tuple[Annotated[Point, BeforeValidator(_point)], ...] | None, _count("control points", 1)
    ] = None
    weights: Annotated[tuple[float, ...] | None, BeforeValidator(lambda value: _weights(value))] = None
    translation: Literal["divided", "plain"] = "divided"
    form: Annotated[FormName | None, Field(alias="as")] = None
    sequence: Annotated[str | None, Field(pattern=SEQUENCE)] = None
    unit: Literal["deg", "rad"] | None = None

    @model_validator(mode="after")
    def _form_is_whole(self) -> Self:
        if self.weights is not None and len(self.weights) != len(self.quaternions):
            needed = f"{len(self.quaternions)}, one for each quaternion, are needed"
            raise fault(f"{len(self.weights)} weights; {needed}", "weights")
        refuse_half_form(self.form, {"unit": self.unit, "sequence": self.sequence})
        if "translation" in self.model_fields_set and self.points is None:
            raise fault('it says how "points" are meant, and there are none', "translation")
        return self


Curves = Annotated[tuple[BezierModel, ...], BeforeValidator(as_tuple)]


def refuse_mixed(curves: Sequence[BezierModel]) -> None:
    """All curves move the origin, or none does."""
    if not 1 <= len(curves) <= MOST_CURVES:
        raise fault(f"{len(curves)} curves; 1 to {MOST_CURVES} are needed", "bezier")
    without = [i for i, curve in enumerate(curves) if curve.points is None]
    if without and len(without) < len(curves):
        raise fault('other curves have "points"; they are needed here too', "bezier", without[0])


def refuse_unfit(problem: "Problem") -> None:
    """What a problem of arcs may ask for and a Bézier motion does not have."""
    nodes, easing, curves = problem.nodes, problem.easing, problem.route.bezier or ()
    if problem.objective.minimise != "time":
        raise fault("a Bézier motion is made in least time; nothing else can be asked for", "objective")
    for side in ("start", "end"):
        if getattr(nodes, side) is not None:
            raise fault("a Bézier motion begins and ends at rest", "nodes", side)
    if "double-s" in problem.baselines and "baselines" in problem.model_fields_set:
        raise fault(
            'along curves no double-s is known; "quintic" alone can stand beside the law', "baselines"
        )
    _refuse_rules(problem, len(curves))
    if "basis" in easing.model_fields_set and easing.basis not in BASES:
        raise fault(f'"{easing.basis}"; on Bézier curves {" or ".join(BASES)} is needed', "easing", "basis")


def _refuse_rules(problem: "Problem", count: int) -> None:
    """Rules for joints and curves that are not there, or that cannot be kept."""
    labels = [str(i + 1) for i in range(count + 1)]
    for label, rule in problem.nodes.at.items():
        if label not in labels:
            raise fault(f'no such node; the curves join "1" to "{labels[-1]}"', "nodes", "at", label)
        for key in ("time", "limits"):
            if getattr(rule, key) is not None:
                raise fault('only "dwell" and "stop" can be asked of a joint of curves', "nodes", "at", label)
    legs = [f"{a}-{b}" for a, b in pairwise(labels)]
    for leg, segment in problem.segments.items():
        if leg not in legs:
            raise fault(f'no such curve; they are called "{legs[0]}" to "{legs[-1]}"', "segments", leg)
        if segment.duration is not None:
            raise fault("the time of a curve cannot be given", "segments", leg, "duration")
