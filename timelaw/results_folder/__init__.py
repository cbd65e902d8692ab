"""Folders of results that appear whole: written beside, put in place at once, repaired by the next run."""

from timelaw.results_folder.repair import repair_results
from timelaw.results_folder.write import write_results

__all__ = ["repair_results", "write_results"]
