"""A law to be compared: from a law file, a folder of results, or designed from a problem file."""

from dataclasses import dataclass, replace
from pathlib import Path

from timelaw.certificate import certify
from timelaw.errors import Fault, InputError
from timelaw.law_file import read_law
from timelaw.pipeline import Certified, design_problem
from timelaw.pipeline_bezier import design_curves
from timelaw.problem import load_problem
from timelaw.progress import Progress, tell

LAW, SUFFIX = "law.json", ".json"
OPTIMISED = "optimised"


@dataclass(frozen=True)
class Compared:
    """A certified law under the name it is compared by, and where it is from."""

    entry: Certified
    source: str


def read_compared(given: str, progress: Progress | None = None) -> Compared:
    """What an argument of `timelaw compare` means.

    Raises:
        InputError: there is no such file, a folder holds no law, or the file is wrong.
        InfeasibleError: a problem has no law.
    """
    path = Path(given)
    if path.is_dir():
        if not (path / LAW).is_file():
            raise InputError(Fault(f'a folder without results: it has no "{LAW}"', "", given))
        path = path / LAW
    if path.suffix.lower() == SUFFIX:
        law, _ = read_law(path)
        tell(progress, f"proving {given}")
        return Compared(Certified(law.name, law, certify(law)), given)
    problem, source = load_problem(path)
    if problem.route.bezier:
        found = design_curves(path, problem, source, progress).optimised
    else:
        found = design_problem(path, problem, source, progress).optimised
    return Compared(replace(found, name=found.law.name), given)


def name_apart(laws: list[Compared]) -> list[Compared]:
    """By their own names; those that share one by where they are from."""
    names = [law.entry.name for law in laws]
    return [
        law
        if names.count(law.entry.name) == 1
        else replace(law, entry=replace(law.entry, name=_shorten(law.source, laws)))
        for law in laws
    ]


def _shorten(source: str, laws: list[Compared]) -> str:
    """The end of a path that no other has; the whole where there is none."""
    parts = Path(source).parts
    for count in range(1, len(parts) + 1):
        end = parts[-count:]
        if sum(Path(other.source).parts[-count:] == end for other in laws) == 1:
            return "/".join(end)
    return source
