"""Time laws: when the body is where on its route. They know no quaternions."""

from timelaw.time_law.baselines import BASELINES
from timelaw.time_law.time_law import TimeLaw

__all__ = ["BASELINES", "TimeLaw"]
