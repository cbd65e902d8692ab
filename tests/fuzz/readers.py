"""Every reader as the commands use it, and the judgement of what came of an input."""

import contextlib
import io
import traceback
import warnings
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from tests.campaign.judge import HANG, TRACEBACK
from timelaw.bezier.joints import find_joints
from timelaw.bezier.read import read_curves
from timelaw.cli.verify import run as verify
from timelaw.errors import EXIT_BAD_INPUT, EXIT_INFEASIBLE, TimelawError
from timelaw.orientations import read_orientations
from timelaw.orientations.angle_files import read_angles
from timelaw.orientations.attitude_files import ATTITUDE_READERS
from timelaw.orientations.forms import Writing
from timelaw.orientations.table import read_table
from timelaw.pipeline import lay_out_problem
from timelaw.problem import load_problem
from timelaw.problem.load import check_problem
from timelaw.problem.route import SEARCHED
from timelaw.study.study import read_study

RESULT, REFUSAL, MUTE = "result", "refusal", "refused without a word"
VERDICTS = (RESULT, REFUSAL, MUTE, TRACEBACK, HANG)
FAILED = (MUTE, TRACEBACK, HANG)
FEW_SEARCHED, FEW_GIVEN = 8, 60  # orientations: searching for a tour is no reading
COARSE = 0.5  # rad; finer uniform sets take a while to be made
POINTS = 3  # of a study that are looked at
WRITINGS = (
    (None, None),
    (Writing("xyzw"), None),
    (Writing("euler", "ZXZ", "deg"), ("phi1", "Phi", "phi2")),
    (Writing("rotation-vector", unit="rad"), None),
    (Writing("matrix"), None),
    (Writing("euler", "xyz", "rad"), (1, 2, 3)),
)


@dataclass(frozen=True)
class Outcome:
    """What came of an input."""

    verdict: str
    message: str = ""


def read_problem(path: Path) -> None:
    """Its orientations too, and the route where the set is small; or its curves with their joints."""
    problem, source = load_problem(path)
    route = problem.route
    if route.orientations is None:
        with source.placed():
            find_joints(read_curves(problem))
        return
    uniform = route.orientations.uniform
    if uniform is not None and uniform.fill < COARSE:
        return
    with source.placed():
        count = len(read_orientations(route.orientations, path.parent))
    if count <= (FEW_SEARCHED if route.tour in SEARCHED else FEW_GIVEN):
        lay_out_problem(path, problem, source)


def read_whole_study(path: Path) -> None:
    """The first problems it makes too."""
    study = read_study(path)
    for point in islice(study.points(), POINTS):
        check_problem(study.base.with_values(point))


def read_tables(path: Path) -> None:
    """In every form; a refusal if all of them refuse it."""
    refusals = []
    for writing, columns in WRITINGS:
        try:
            read_table(path, writing, columns)
        except TimelawError as error:
            refusals.append(error)
    for refusal in refusals:
        _judge_refusal(refusal)
    if len(refusals) == len(WRITINGS):
        raise refusals[0]


def read_map(path: Path) -> None:
    """In both units; a refusal if both refuse it."""
    try:
        read_angles(path)
    except TimelawError:
        read_angles(path, "deg")


def read_attitude(path: Path) -> None:
    """By its ending."""
    ATTITUDE_READERS[path.suffix](path)


def verify_law(path: Path) -> None:
    """All that `verify` does and prints."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        verify(str(path), as_json=True)


READERS = {
    "problem": read_problem,
    "study": read_whole_study,
    "table": read_tables,
    "angles": read_map,
    "attitude": read_attitude,
    "law": verify_law,
}


def judge_input(kind: str, path: Path) -> Outcome:
    """Read a file; a warning on the user's screen counts as a traceback."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            READERS[kind](path)
    except TimelawError as error:
        return _judge_refusal(error)
    except Exception:  # whatever it is, it is what is looked for
        return Outcome(TRACEBACK, traceback.format_exc())
    return Outcome(RESULT)


def _judge_refusal(error: TimelawError) -> Outcome:
    """Every fault has a message that can be printed, and the exit code is one of bad input."""
    whole = error.faults and all(fault.message.strip() for fault in error.faults)
    if not whole or error.exit_code not in (EXIT_BAD_INPUT, EXIT_INFEASIBLE):
        return Outcome(MUTE, repr(error))
    return Outcome(REFUSAL, str(error))
