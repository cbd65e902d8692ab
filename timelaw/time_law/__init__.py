"""Time laws: when the body is where on its route. They know no quaternions."""

from timelaw.time_law.baselines import BASELINES, double_s, physical_limit, quintic
from timelaw.time_law.optimised import optimised
from timelaw.time_law.time_law import TimeLaw

__all__ = ["BASELINES", "TimeLaw", "double_s", "optimised", "physical_limit", "quintic"]
