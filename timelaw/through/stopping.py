"""The law that stops at corners: a motion through the nodes is measured by it, and falls back on it."""

from dataclasses import replace

from timelaw.easing.family import classify_profile
from timelaw.least_time.phase_plane import has_coupling
from timelaw.problem import Problem
from timelaw.problem.objective import Goal
from timelaw.problem.problem import EasingModel
from timelaw.requirements import Requirements


def relax(problem: Problem, requirements: Requirements) -> tuple[Problem, Requirements]:
    """What is left of a problem without given times and rates at its ends: least time from rest to rest."""
    open_ = tuple(replace(demand, duration=None) for demand in requirements.demands)
    free = replace(requirements, demands=open_, arrivals={}, start=(), end=())
    return problem.model_copy(update={"objective": Goal()}), free


def choose_stopping(problem: Problem, requirements: Requirements) -> Problem:
    """The problem with the easing of the stopping law: the one that is asked for, or the fastest there is.

    The double-S profile is that where limits are on rates alone, nothing else is given, and it is as smooth
    as is asked.
    """
    demands = requirements.demands
    given = "easing" in problem.model_fields_set or problem.objective.minimise != "time"
    given |= bool(requirements.arrivals) or any(d.duration is not None for d in demands)
    given |= any(requirements.start) or any(requirements.end)
    rough = any(classify_profile([demand]) < problem.nodes.continuity for demand in demands)
    if given or rough or any(has_coupling(demand.rows) for demand in demands):
        return problem
    return problem.model_copy(update={"easing": EasingModel(basis="double-s")})
