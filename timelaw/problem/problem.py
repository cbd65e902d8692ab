"""The model of a problem file, version 1: which keys there are and what they may hold."""

from typing import Annotated, Any, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from timelaw.easing.registry import BASES, MAX_DEGREE, BasisKind
from timelaw.limits import LIMITS
from timelaw.limits.body import RigidBody
from timelaw.limits.bounds import Bounds
from timelaw.limits.registry import POINT
from timelaw.objectives import OBJECTIVES
from timelaw.problem.bezier import refuse_unfit
from timelaw.problem.body import Body
from timelaw.problem.fields import Model, as_tuple, fault, one_of, percentage
from timelaw.problem.limits import Limits
from timelaw.problem.motion import LEAST_DEGREES, Motion, read_motion
from timelaw.problem.nodes import Nodes, SegmentRule
from timelaw.problem.objective import Goal, read_goal
from timelaw.problem.output import Output, refuse_grid
from timelaw.problem.route import RouteModel

Baseline = Literal["quintic", "double-s"]
MAX_INTERVALS = 500
NAME = r"^[A-Za-z0-9][A-Za-z0-9._-]*$"


class EasingModel(Model):
    """The function family of the easing f(τ) on a leg; `auto` looks for the cheapest that comes `within`.

    A degree without a basis is that of a polynomial.
    """

    basis: Annotated[str, one_of(BASES)] = "auto"
    degree: Annotated[int, Field(ge=3, le=MAX_DEGREE)] | None = None
    intervals: Annotated[int, Field(ge=1, le=MAX_INTERVALS)] | None = None
    within: Annotated[float | None, percentage()] = None

    @property
    def kind(self) -> BasisKind:
        """What the basis is."""
        return BASES[self.basis]

    @model_validator(mode="before")
    @classmethod
    def _degree_alone(cls, value: Any) -> Any:
        plain = isinstance(value, dict) and "degree" in value and "basis" not in value
        return {**value, "basis": "polynomial"} if plain else value

    @model_validator(mode="after")
    def _suit_the_basis(self) -> Self:
        for key in ("degree", "intervals", "within"):
            if getattr(self, key) is not None and key not in self.kind.keys:
                fitting = [basis for basis, kind in BASES.items() if key in kind.keys]
                raise fault(f"{key} belongs to the basis {' or '.join(fitting)}, not to {self.basis}", key)
        least, most = self.kind.degrees
        if self.degree is not None and not least <= self.degree <= most:
            raise fault(f"{self.degree}; a {self.basis} has a degree of {least} to {most}", "degree")
        return self


class Problem(Model):
    """A problem file, version 1."""

    timelaw: Literal[1]
    name: Annotated[str, Field(pattern=NAME, max_length=100)]
    route: RouteModel
    body: Body | None = None
    limits: Limits
    nodes: Nodes = Nodes()
    motion: Annotated[Motion, BeforeValidator(read_motion)] = Motion()
    segments: dict[str, SegmentRule] = Field(default_factory=dict)
    easing: EasingModel = EasingModel()
    objective: Annotated[Goal, BeforeValidator(read_goal)] = Goal()
    baselines: Annotated[tuple[Baseline, ...], BeforeValidator(as_tuple)] = ("quintic", "double-s")
    output: Output = Output()

    @model_validator(mode="after")
    def _basis_carries_continuity(self) -> Self:
        r, degree = self.nodes.continuity, self.easing.degree
        least = self.easing.kind.least_degree(r)
        if degree is not None and degree < least:
            raise fault(
                f"{degree}; continuity {r} at the nodes needs degree {least} or more", "easing", "degree"
            )
        intervals, fewest = self.easing.intervals, self.easing.kind.least_intervals(self.easing, r)
        if intervals is not None and intervals < fewest:
            needed = f"continuity {r} at the nodes needs {fewest} or more, or a higher degree"
            raise fault(f"{intervals}; {needed}", "easing", "intervals")
        return self

    @model_validator(mode="after")
    def _curves_suit(self) -> Self:
        if self.route.bezier:
            refuse_unfit(self)
        return self

    @model_validator(mode="after")
    def _double_s_is_rigid(self) -> Self:
        if not self.easing.kind.rigid:
            return self
        times = any(rule.time is not None for rule in self.nodes.at.values())
        durations = any(rule.duration is not None for rule in self.segments.values())
        apart = OBJECTIVES[self.objective.minimise].separable
        if not apart or times or durations or self.nodes.moving_start or self.nodes.end:
            raise fault(
                "a double-s has the least time from rest to rest; it keeps no given times", "easing", "basis"
            )
        highest = max((LIMITS[name].smooths for limits in self._all_limits() for name in limits), default=0)
        if self.nodes.continuity > highest:
            given = self.nodes.continuity
            raise fault(
                f"under these limits a double-s has continuity {highest}, not {given}: 2 where the jerk is "
                "limited, 1 where acceleration or torque is, 0 where neither is",
                "easing",
                "basis",
            )
        return self

    def _all_limits(self) -> list[dict[str, Bounds]]:
        """Those of the whole motion, of single legs and at single nodes."""
        own = [rule.limits for rule in self.segments.values()] + [
            rule.limits for rule in self.nodes.at.values()
        ]
        return [self.limits.given(), *(limits.given() for limits in own if limits)]

    @model_validator(mode="after")
    def _effort_is_finite(self) -> Self:
        what, r, degree = self.objective.minimise, self.nodes.continuity, self.easing.degree
        least = OBJECTIVES[what].continuity
        if r < least:
            message = f"to minimise {what}, continuity {least} at the nodes is needed, not {r}"
            raise fault(message, "objective", "minimise")
        if self.easing.kind.pieces and degree is not None and degree <= least:
            needed = f"a {self.easing.basis} of degree {least + 1} or more is needed, not {degree}"
            raise fault(f"to minimise {what}, {needed}", "objective", "minimise")
        return self

    @model_validator(mode="after")
    def _times_are_free(self) -> Self:
        refuse_grid(self)
        return self

    @model_validator(mode="after")
    def _end_rates_are_continuous(self) -> Self:
        for name, rates in (("start", self.nodes.moving_start), ("end", self.nodes.end)):
            for order, key in ((2, "acceleration"), (3, "jerk")):
                if rates and getattr(rates, key) and order > self.nodes.continuity:
                    message = f"the {key} jumps with continuity {self.nodes.continuity}; ask for {order}"
                    raise fault(message, "nodes", name, key)
        return self

    @model_validator(mode="after")
    def _limits_make_sense(self) -> Self:
        places: list[tuple[tuple[str, ...], Limits]] = [(("limits",), self.limits)]
        places += [
            (("segments", leg, "limits"), rule.limits) for leg, rule in self.segments.items() if rule.limits
        ]
        places += [
            (("nodes", "at", node, "limits"), r.limits) for node, r in self.nodes.at.items() if r.limits
        ]
        for where, limits in places:
            for name in limits.given():
                if LIMITS[name].needs_translation and not self.route.travels:
                    needed = 'curves with "points" under "bezier"; on arcs the body only turns'
                    raise fault(f"a limit on the {name} needs {needed}", *where, name)
                if LIMITS[name].needs_inertia and self.rigid_body() is None:
                    raise fault(f'a limit on the {name} needs "body: {{inertia: …}}"', *where, name)
                reason = LIMITS[name].contradiction(limits.given()[name], self.rigid_body() or POINT)
                if reason:
                    raise fault(reason, *where, name)
                least = LIMITS[name].continuity
                if self.nodes.continuity < least:
                    given = self.nodes.continuity
                    raise fault(
                        f"a limit on the {name} needs continuity {least} at the nodes, not {given}",
                        *where,
                        name,
                    )
        minimise = self.objective.minimise
        if OBJECTIVES[minimise].needs_inertia and self.rigid_body() is None:
            raise fault(f'to minimise {minimise}, "body: {{inertia: …}}" is needed', "objective", "minimise")
        if OBJECTIVES[minimise].needs_inertia and any(self.body.momentum if self.body else ()):
            message = f"to minimise {minimise}, a total momentum of zero is needed: H turns against the body"
            raise fault(f"{message}; minimise energy instead", "objective", "minimise")
        return self

    @model_validator(mode="after")
    def _motion_carries_continuity(self) -> Self:
        if not self.motion.through:
            self._go_along_arcs()
            return self
        if self.nodes.periodic and not self.route.closed:
            raise fault("only a closed tour goes round; add closed: true to the route", "nodes", "start")
        r, (degree, _) = self.nodes.continuity, self.motion.chosen
        if r not in LEAST_DEGREES:
            reason = "the states of nodes are ω, α and jerk, whose derivative jumps"
            raise fault(f"{r}; a motion through the nodes has at most 3: {reason}", "nodes", "continuity")
        if degree is not None and degree < LEAST_DEGREES[r]:
            least = LEAST_DEGREES[r]
            raise fault(f"{degree}; continuity {r} at the nodes needs {least} or more", "motion", "degree")
        return self

    def _go_along_arcs(self) -> None:
        """Refuse what only a motion through the nodes can do."""
        if self.nodes.periodic:
            message = "along the arcs the body stops where the axis turns; motion: through goes round"
            raise fault(message, "nodes", "start")
        for name, rates in (("start", self.nodes.start), ("end", self.nodes.end)):
            if rates and rates.in_body_axes:
                message = (
                    "along the arcs a rate is about the axis of its leg; motion: through takes body axes"
                )
                raise fault(message, "nodes", name, rates.in_body_axes[0])

    def rigid_body(self) -> RigidBody | None:
        """The body, if given."""
        return self.body.rigid_body() if self.body else None
