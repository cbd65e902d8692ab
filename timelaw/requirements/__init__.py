"""Requirements: what must hold on each leg and at each node of the route, before any time is chosen."""

from timelaw.requirements.requirements import Requirements, resolve_requirements
from timelaw.requirements.run_demand import RunDemand

__all__ = ["Requirements", "RunDemand", "resolve_requirements"]
