"""The law that stops at corners: a motion through the nodes is measured by it, and falls back on it."""

from dataclasses import replace

from timelaw.easing.double_s_easing import classify_profile
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


def list_stopping(problem: Problem, requirements: Requirements) -> list[Problem]:
    """The problem with the easings of laws that stop, of which the fastest counts.

    The one that is asked for, where one is, or anything is given besides limits. Else the double-S profile,
    where it is as smooth as is asked; under limits that tie rates together the solver's beside it, which may
    be faster.
    """
    demands = requirements.demands
    given = "easing" in problem.model_fields_set or problem.objective.minimise != "time"
    given |= bool(requirements.arrivals) or any(d.duration is not None for d in demands)
    given |= any(requirements.start) or any(requirements.end)
    rough = any(classify_profile([demand]) < problem.nodes.continuity for demand in demands)
    if given or rough:
        return [problem]
    profile = problem.model_copy(update={"easing": EasingModel(basis="double-s")})
    return [profile, problem] if any(has_coupling(demand.rows) for demand in demands) else [profile]
