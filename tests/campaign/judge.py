"""One problem text: designed, looked at from all sides, and a verdict."""

import re
import resource
import tempfile
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path

from tests.campaign.answer_checks import ANSWER_CHECKS
from tests.campaign.curve_checks import CurveEvidence, look_at_curves
from tests.campaign.curve_refusal import judge_curve_refusal
from tests.campaign.evidence import Evidence
from tests.campaign.law_checks import LAW_CHECKS, arcs_are_kept
from tests.campaign.passing import PASSING_CHECKS
from tests.campaign.refusal import CONFIRMED, UNCONFIRMED, WRONG, judge_input_error, judge_refusal
from tests.campaign.spec import Spec, read_spec
from timelaw import design
from timelaw.cli.bezier import list_files as list_curve_files
from timelaw.cli.design import list_files
from timelaw.errors import InfeasibleError, InputError
from timelaw.pipeline_bezier import design_curves
from timelaw.problem import load_problem
from timelaw.time_limit import limit_time

CERTIFIED, SLOW, NOT_CERTIFIED = "certified", "slow", "not certified"
TRACEBACK, HANG = "traceback", "hang"
VERDICTS = (CERTIFIED, SLOW, CONFIRMED, UNCONFIRMED, NOT_CERTIFIED, TRACEBACK, HANG, WRONG)
FAILED = (NOT_CERTIFIED, TRACEBACK, HANG, WRONG)

TOO_MANY = re.compile(r"output.rate: \d+ rows")
ROWS, MOST_ROWS = re.compile(r"output.rate: (\d+) rows in"), 2_000_000
LINES = 9  # of a traceback: its end says where


@dataclass
class Result:
    """The verdict on a problem, what was found, and what was measured."""

    verdict: str
    findings: list[str] = field(default_factory=list)
    message: str = ""
    jump: float = 0.0
    beyond: float = 0.0
    status: list[str] = field(default_factory=list)
    designing: float = 0.0
    seconds: float = 0.0

    @property
    def failed(self) -> bool:
        """Whether the program is wrong here, as far as is known."""
        return self.verdict in FAILED

    def to_dict(self) -> dict:
        return asdict(self)


def cpu() -> float:
    """Time [s] this process has used."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def judge(text: str, *, files: bool = False) -> Result:
    """Design a problem and judge the answer; with `files` all that `timelaw design` writes is made too."""
    begun = cpu()
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        path = Path(folder) / "problem.yaml"
        path.write_text(text)
        result = _design_and_look(path, text, files=files)
    ours = [w for w in heard if "timelaw" in w.filename.split("/")[:-1]]
    if ours and not result.failed:
        result.verdict = WRONG
    result.findings += sorted({f"warning: {w.category.__name__}: {w.message}" for w in ours})
    result.seconds = cpu() - begun
    return result


def judge_hurried(text: str, seconds: float) -> Result:
    """Design a problem that takes long, told to end after so many of wall time: with a certified law, or none."""
    begun = cpu()
    with tempfile.TemporaryDirectory() as folder, limit_time(seconds):
        path = Path(folder) / "problem.yaml"
        path.write_text(text)
        try:
            curved = read_spec(text).curved
            done = design_curves(path, *load_problem(path)) if curved else design(path)
        except InfeasibleError as error:
            ended = "time limit" in str(error)
            result = Result(SLOW if ended else WRONG, [] if ended else [f"in a hurry: {error}"], str(error))
        except Exception:  # the very thing that is looked for
            result = _crashed(begun)
        else:
            findings = [f"in a hurry: {finding}" for finding in done.optimised.certificate.findings()]
            result = Result(NOT_CERTIFIED if findings else SLOW, findings, "ended with the best law so far")
    result.seconds = cpu() - begun
    return result


def _design_and_look(path: Path, text: str, *, files: bool) -> Result:
    spec, begun = read_spec(text), cpu()
    if spec.curved:
        return _design_curves(path, spec, begun, files=files)
    try:
        done = design(path)
        left_out = _make_files(done, path) if files else ""
    except InfeasibleError as error:
        return _refused(str(error), cpu() - begun, *judge_refusal(spec, str(error)))
    except InputError as error:
        return _refused(str(error), cpu() - begun, *judge_input_error(spec, str(error)))
    except Exception:  # the very thing that is looked for
        return _crashed(begun)
    took = cpu() - begun
    evidence = Evidence(spec, done)
    findings = [left_out] if left_out else []
    verdict, findings = _weigh(done, [*findings, *look(evidence)])
    jump = max((jump[0] for jump in evidence.jumps), default=0.0)
    status = sorted({s.status.name for s in done.solution.solutions})
    return Result(verdict, findings, "", float(jump), evidence.beyond, status, took)


def _design_curves(path: Path, spec: Spec, begun: float, *, files: bool) -> Result:
    """The same along Bézier curves."""
    try:
        problem, source = load_problem(path)
        done = design_curves(path, problem, source)
        left_out = (
            [f"files: {why}" for why in list_curve_files(done)[1] if not TOO_MANY.search(why)]
            if files
            else []
        )
    except (InfeasibleError, InputError) as error:
        return _refused(str(error), cpu() - begun, *judge_curve_refusal(spec, str(error)))
    except Exception:  # the very thing that is looked for
        return _crashed(begun)
    took = cpu() - begun
    verdict, findings = _weigh(done, [*left_out, *look_at_curves(CurveEvidence(spec, done))])
    certificate = done.optimised.certificate
    jump = max(certificate.continuity.worst.values(), default=0.0)
    status = ["STOPPED" if run.found.stopped else "CONVERGED" for run in done.runs]
    return Result(verdict, findings, "", float(jump), 0.0, sorted(set(status)), took)


def _weigh(done, findings: list[str]) -> tuple[str, list[str]]:
    """The verdict, and all that was found."""
    certificate = done.optimised.certificate
    if certificate.holds:
        return (WRONG if findings else CERTIFIED), findings
    return NOT_CERTIFIED, [*(f"certificate: {finding}" for finding in certificate.findings()), *findings]


def _crashed(begun: float) -> Result:
    """Of an exception that nobody caught."""
    lines = traceback.format_exc().splitlines()
    return Result(TRACEBACK, ["\n".join(lines[-LINES:])], designing=cpu() - begun)


def _make_files(done, path: Path) -> str:
    """What is wrong with all the files that are written; more rows than are allowed may be refused."""
    try:
        list_files(done, path)
    except InputError as error:
        rows = ROWS.search(str(error))
        wanted = done.optimised.law.duration * done.problem.output.rate
        if rows is None or wanted < MOST_ROWS or abs(int(rows.group(1)) - wanted) > 2:
            return f"files: {error}"
    return ""


def _refused(message: str, took: float, verdict: str, why: str) -> Result:
    return Result(verdict, [why] if why else [], message.partition(".yaml")[2] or message, designing=took)


def look(evidence: Evidence) -> Iterator[str]:
    """All that is wrong with a law."""
    checks = (*LAW_CHECKS, *ANSWER_CHECKS)
    if evidence.spec.through:
        checks = (*(check for check in LAW_CHECKS if check is not arcs_are_kept), *PASSING_CHECKS)
    for check in checks:
        yield from check(evidence)
