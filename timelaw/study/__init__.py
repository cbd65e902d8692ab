"""Studies: one problem designed many times over, with some of its keys varied."""

from timelaw.study.outcome import Outcome
from timelaw.study.run import plan_study, run_study
from timelaw.study.study import Study, read_study

__all__ = ["Outcome", "Study", "plan_study", "read_study", "run_study"]
