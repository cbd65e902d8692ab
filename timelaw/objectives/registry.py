"""The registry of objectives, by the key they have in problem files."""

from timelaw.objectives.effort import EFFORTS
from timelaw.objectives.objective import Objective
from timelaw.objectives.peak import LeastPeak
from timelaw.objectives.time import LeastTime

_ALL: tuple[Objective, ...] = (LeastTime(), *EFFORTS.values(), LeastPeak())
OBJECTIVES: dict[str, Objective] = {objective.name: objective for objective in _ALL}
