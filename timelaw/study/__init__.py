"""Studies: one problem designed many times over, with some of its keys varied."""

from timelaw.study.run import Outcome, run_study
from timelaw.study.study import Study, read_study

__all__ = ["Outcome", "Study", "read_study", "run_study"]
