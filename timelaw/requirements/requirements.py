"""Resolve what the problem file says about legs and nodes, by label, onto a route."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from timelaw.easing.double_s_easing import classify_profile
from timelaw.errors import Fault, InputError, list_some
from timelaw.limits import Bounds, Demand, drop_implied, list_rows, make_limits
from timelaw.limits.body import RigidBody
from timelaw.limits.torque import make_torque_row
from timelaw.problem import Problem
from timelaw.problem.nodes import EndRates, NodeRule, SegmentRule
from timelaw.problem.route import SEARCHED
from timelaw.requirements.arrivals import check_arrivals
from timelaw.requirements.end_rates import check_end_rates, ease_end_rates
from timelaw.requirements.run_demand import RunDemand
from timelaw.route import Route, Run


@dataclass(frozen=True)
class Requirements:
    """Demands per leg; per node (one more than legs) dwells [s], stops and arrival times [s].

    `start` and `end` are the rates φ', φ'', … outside the motion, about the first and last leg's
    axis; empty means rest. `limits` and `leg_limits` are the bounds as the law file records them, `shape` the
    edges [m] of the box that pictures show.
    """

    demands: tuple[Demand, ...]
    dwells: tuple[float, ...]
    stops: frozenset[int]
    arrivals: Mapping[int, float]
    start: tuple[float, ...]
    end: tuple[float, ...]
    limits: Mapping[str, Bounds]
    leg_limits: Mapping[int, Mapping[str, Bounds]]
    body: RigidBody | None
    shape: tuple[float, float, float] | None = None

    @property
    def dwell_time(self) -> float:
        """Time [s] spent at rest on purpose."""
        return sum(self.dwells)

    def runs(self, route: Route) -> tuple[Run, ...]:
        """The route cut at corners, forced stops and dwells."""
        return route.runs(self.stops)

    def by_run(self, route: Route, *, stop: bool = False) -> list[RunDemand]:
        """The demands run by run, or with `stop` leg by leg, and how the motion begins and ends."""
        legs = (
            [range(k, k + 1) for k in range(len(route.legs))] if stop else [r.legs for r in self.runs(route)]
        )
        runs = [RunDemand(tuple(self.demands[k] for k in run), where=self._where(route, run)) for run in legs]
        runs[0] = replace(runs[0], start=ease_end_rates(self.start, self.demands[0]))
        runs[-1] = replace(runs[-1], end=ease_end_rates(self.end, self.demands[-1]))
        return runs

    def _where(self, route: Route, legs: range) -> str:
        """The key that says what is hard about a run: its fixed duration, or how it begins or ends."""
        fixed = [k for k in legs if self.demands[k].duration is not None]
        if fixed:
            leg = route.legs[fixed[0]]
            return f"segments.{leg.origin}-{leg.target}.duration"
        return "nodes.start" if any(self.start) and 0 in legs else "nodes.end"


def resolve_requirements(problem: Problem, route: Route) -> Requirements:
    """What the problem demands, leg by leg and node by node.

    Raises:
        InputError: a label or leg that the tour does not have.
    """
    given, body = problem.limits.given(), problem.rigid_body()
    rules, legs = _node_rules(problem, route), _leg_rules(problem, route)
    own = _leg_limits(problem, route, rules, legs)
    base = make_limits(given, body)
    demands = []
    for index, leg in enumerate(route.legs):
        rule = legs.get(index)
        extra = make_limits(own.get(index, {}), body)
        rows = drop_implied((*list_rows(base, leg.axis), *list_rows(extra, leg.axis)))
        if not rows:
            message = f"no limit bounds the motion of leg {leg.name}; add a norm limit"
            raise InputError(Fault(message, "limits"))
        torque = make_torque_row(body, leg.axis) if body is not None else None
        demands.append(Demand(leg.angle, rows, rule.duration if rule else None, torque))
    dwells = _dwells(problem, route, rules)
    if problem.easing.kind.rigid:
        _check_profile(problem, route, demands)
    stops = {i for i, rule in rules.items() if rule.stop} | {i for i, d in enumerate(dwells) if d > 0}
    arrivals: dict[int, float] = {i: rule.time for i, rule in rules.items() if rule.time is not None}
    check_arrivals(route, arrivals, dwells, problem.objective.total_time)
    ends = problem.nodes.moving_start, problem.nodes.end
    start, end = (_rates_about_legs(problem, given) for given in ends)
    check_end_rates("start", start, demands[0])
    check_end_rates("end", end, demands[-1])
    return Requirements(
        tuple(demands),
        dwells,
        frozenset(stops),
        arrivals,
        start,
        end,
        given,
        own,
        body,
        problem.body.shape if problem.body else None,
    )


def _rates_about_legs(problem: Problem, given: EndRates | None) -> tuple[float, ...]:
    """Rates about the axis of the leg at an end; none where they are given in body axes."""
    if given is None or given.in_body_axes:
        return ()
    return tuple(float(rate) for rate in given.rates(problem.nodes.continuity) if not isinstance(rate, tuple))


def _check_profile(problem: Problem, route: Route, demands: Sequence[Demand]) -> None:
    """Refuse a double-S where the limits of some leg leave it less smooth than is asked."""
    for leg, demand in zip(route.legs, demands, strict=True):
        found = classify_profile([demand])
        if found < problem.nodes.continuity:
            asked = problem.nodes.continuity
            message = f"under the limits on leg {leg.name} a double-s has continuity {found}, not {asked}"
            raise InputError(Fault(message, "easing.basis"))


def _node_rules(problem: Problem, route: Route) -> dict[int, NodeRule]:
    """Rules by the index of the node on the route; a rule holds at every visit to its node."""
    labels = _list_visits(problem, route)
    rules = {}
    for label, rule in problem.nodes.at.items():
        where = f"nodes.at.{label}"
        visits = [i for i, there in enumerate(labels) if there == label]
        if not visits and label in route.merged:
            visits = [route.merged[label]]
            if visits[0] in rules or labels[visits[0]] in problem.nodes.at:
                message = f'"{label}" and "{labels[visits[0]]}" are one node; give its rules once'
                raise InputError(Fault(message, where))
        if not visits:
            message = f'the tour has no node "{label}"; it has {list_some(list(dict.fromkeys(labels)))}'
            raise InputError(Fault(message, where))
        if rule.time is not None and len(visits) > 1:
            message = f'the tour visits "{label}" {len(visits)} times; it is not said which visit is meant'
            raise InputError(Fault(message, f"{where}.time"))
        stop = rule.stop and problem.route.tour not in SEARCHED  # a searched tour may end where one is due
        ends = (0, len(route.nodes) - 1)
        if (stop and all(i in ends for i in visits)) or (rule.time is not None and visits[0] == 0):
            message = (
                f'"{label}" is where the motion starts or ends; "stop" and a start time have no meaning there'
            )
            raise InputError(Fault(message, where))
        rules.update(dict.fromkeys(visits, rule))
    return rules


def _list_visits(problem: Problem, route: Route) -> list[str]:
    """Labels of the nodes; the return of a closed tour to its first node is no second visit."""
    labels = [node.label for node in route.nodes]
    return labels[:-1] if problem.route.closed else labels


def _leg_rules(problem: Problem, route: Route) -> dict[int, SegmentRule]:
    """Rules by the index of the leg; a leg is written "from-to", and a rule holds whenever it is gone."""
    names = [f"{leg.origin}-{leg.target}" for leg in route.legs]
    rules = {}
    for name, rule in problem.segments.items():
        found = [i for i, there in enumerate(names) if there == name]
        if not found:
            listing = list_some(list(dict.fromkeys(names)))
            raise InputError(Fault(f'the tour has no leg "{name}"; it has {listing}', f"segments.{name}"))
        legs = {(route.legs[i].origin, route.legs[i].target) for i in found}
        if len(legs) > 1:
            ways = " or ".join(f'from "{origin}" to "{target}"' for origin, target in sorted(legs))
            raise InputError(Fault(f'"{name}" may be {ways}; choose other labels', f"segments.{name}"))
        rules.update(dict.fromkeys(found, rule))
    return rules


def _leg_limits(
    problem: Problem, route: Route, rules: Mapping[int, NodeRule], legs: Mapping[int, SegmentRule]
) -> dict[int, dict[str, Bounds]]:
    """Limits of single legs: their own, and those of the nodes at both ends; the tightest of each counts."""
    given = [
        (i, f"segments.{route.legs[i].origin}-{route.legs[i].target}", rule.limits)
        for i, rule in legs.items()
    ]
    closed = problem.route.closed
    for node, rule in rules.items():
        where = f"nodes.at.{route.nodes[node].label}"
        meet = (node - 1 if node or not closed else len(route.legs) - 1, node)
        given += [(i, where, rule.limits) for i in meet if 0 <= i < len(route.legs)]
    found: dict[int, dict[str, Bounds]] = {}
    for index, where, limits in given:
        for name, bounds in limits.given().items() if limits else ():
            own = found.setdefault(index, {})
            tighter = _tighter(own.get(name, bounds), bounds)
            if tighter is None:
                message = f"{name} on leg {route.legs[index].name} is given both as a norm and by axis"
                raise InputError(Fault(message, where))
            own[name] = tighter
    return found


def _tighter(one: Bounds, other: Bounds) -> Bounds | None:
    """The tighter of two norms, or axis by axis; None for a norm and axes."""
    if isinstance(one, tuple) and isinstance(other, tuple):
        return (min(one[0], other[0]), min(one[1], other[1]), min(one[2], other[2]))
    return None if isinstance(one, tuple) or isinstance(other, tuple) else min(one, other)


def _dwells(problem: Problem, route: Route, rules: Mapping[int, NodeRule]) -> tuple[float, ...]:
    """Dwell at every node but where the motion begins or ends moving.

    The return of a closed tour to its first node is no second visit.
    """
    last = len(route.nodes) - 1
    moving = {0: problem.nodes.moving_start, last: problem.nodes.end}
    closed = problem.route.closed
    dwells = []
    for index, node in enumerate(route.nodes):
        general = 0.0 if moving.get(index) or (closed and index == last) else problem.nodes.dwell
        own = rules[index].dwell if index in rules else None
        if own and moving.get(index):
            message = f'the motion begins or ends moving at "{node.label}", where it cannot dwell'
            raise InputError(Fault(message, f"nodes.at.{node.label}.dwell"))
        dwells.append(general if own is None else own)
    return tuple(dwells)
