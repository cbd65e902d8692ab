"""Every word with which IPOPT can end, and what to do about it."""

from enum import Enum


class Verdict(Enum):
    """IPOPT's own word for its end; a claim, not evidence."""

    SOLVED = "Solve_Succeeded"
    ACCEPTABLE = "Solved_To_Acceptable_Level"
    FEASIBLE_POINT = "Feasible_Point_Found"
    INFEASIBLE = "Infeasible_Problem_Detected"
    SMALL_STEPS = "Search_Direction_Becomes_Too_Small"
    DIVERGING = "Diverging_Iterates"
    STOPPED = "User_Requested_Stop"
    ITERATIONS = "Maximum_Iterations_Exceeded"
    CPU_TIME = "Maximum_CpuTime_Exceeded"
    WALL_TIME = "Maximum_WallTime_Exceeded"
    RESTORATION = "Restoration_Failed"
    STEP = "Error_In_Step_Computation"
    TOO_FEW_VARIABLES = "Not_Enough_Degrees_Of_Freedom"
    DEFINITION = "Invalid_Problem_Definition"
    OPTION = "Invalid_Option"
    NUMBER = "Invalid_Number_Detected"
    UNRECOVERABLE = "Unrecoverable_Exception"
    FOREIGN = "NonIpopt_Exception_Thrown"
    MEMORY = "Insufficient_Memory"
    INTERNAL = "Internal_Error"

    @property
    def acceptable(self) -> bool:
        """Whether IPOPT claims to have a solution."""
        return self in (Verdict.SOLVED, Verdict.ACCEPTABLE)

    @property
    def remedy(self) -> str:
        """What to do next, where that was the end of it."""
        return REMEDIES[self]


_OURS = "this is a defect of timelaw: please report the problem file"
_EASING = "try another easing or degree"
REMEDIES = {
    Verdict.SOLVED: "nothing is to be done",
    Verdict.ACCEPTABLE: f"the law may not be least; {_EASING}",
    Verdict.FEASIBLE_POINT: _OURS,  # only of programs without an objective, which ours have
    Verdict.INFEASIBLE: "give more time or larger limits, or an easing with more freedom",
    Verdict.SMALL_STEPS: f"the program is nearly degenerate; {_EASING}",
    Verdict.DIVERGING: f"nothing bounds the law; give a limit on a higher rate, or {_EASING}",
    Verdict.STOPPED: "give more time with --time-limit",
    Verdict.ITERATIONS: f"progress is slow; {_EASING}",
    Verdict.CPU_TIME: _OURS,  # whose limits of time are not used
    Verdict.WALL_TIME: _OURS,
    Verdict.RESTORATION: "give more time or larger limits, or an easing with more freedom",
    Verdict.STEP: f"the program is nearly degenerate; {_EASING}",
    Verdict.TOO_FEW_VARIABLES: "use an easing with more freedom: a higher degree or more intervals",
    Verdict.DEFINITION: _OURS,
    Verdict.OPTION: _OURS,
    Verdict.NUMBER: f"numbers overflow; {_EASING}, or limits that differ less",
    Verdict.UNRECOVERABLE: _OURS,
    Verdict.FOREIGN: _OURS,
    Verdict.MEMORY: "use fewer orientations, or an easing of less degree or fewer intervals",
    Verdict.INTERNAL: _OURS,
}


def read_verdict(word: str) -> Verdict:
    """The verdict of IPOPT's word.

    Raises:
        RuntimeError: no such word is known.
    """
    try:
        return Verdict(word)
    except ValueError:
        raise RuntimeError(f'IPOPT ended with "{word}", which timelaw does not know; {_OURS}') from None
