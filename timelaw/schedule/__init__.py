"""The schedule: what the problem demands of each leg and node of the route, before any time is chosen."""

from timelaw.limits import Demand
from timelaw.schedule.schedule import Schedule, schedule

__all__ = ["Demand", "Schedule", "schedule"]
