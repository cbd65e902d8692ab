"""The public face: design a law or load one, evaluate and sample it, plot it, hand it to SciPy."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from timelaw.errors import Fault, InputError
from timelaw.export.arrays import gather_arrays
from timelaw.export.scipy_motion import ScipyMotion
from timelaw.law_file import read_law
from timelaw.motion import QuaternionLaw
from timelaw.pipeline import Design, design_problem
from timelaw.pipeline_bezier import BezierDesign, design_curves
from timelaw.problem import Problem, Source, load_problem
from timelaw.problem.load import check_problem
from timelaw.problem.source import read
from timelaw.progress import Progress

if TYPE_CHECKING:
    from timelaw.report.pictures.render import Figure

FROM_DICT = "problem"  # how messages call a problem that is no file; its tables are looked for from here


class Law(QuaternionLaw):
    """A motion: `law(t)` is its unit quaternion, `law(t, 1)` to `law(t, 4)` ω, α, jerk, snap in body axes."""

    @classmethod
    def of(cls, law: QuaternionLaw) -> "Law":
        """The same motion."""
        return cls(**{field.name: getattr(law, field.name) for field in fields(law)})

    def sample(self, rate: float = 100.0) -> dict[str, Any]:
        """Arrays by name at `rate` [1/s]: t (m,), q (m, 4), omega, alpha, jerk (m, 3) and what else is known.

        Raises:
            InputError: there would be more rows than are written.
            ValueError: the rate is not positive.
        """
        if not 0 < rate < np.inf:
            raise ValueError(f"rate {rate}; a positive number of samples per second is needed")
        return gather_arrays(self, float(rate))

    def plot(self, path: str | Path | None = None) -> "Figure":
        """ω, α, jerk in body axes and their sizes over time, with the limits; written to `path` if given."""
        from timelaw.report.pictures.render import draw_picture

        figure = draw_picture(self, "rates")
        if path is not None:
            figure.savefig(path)
        return figure

    def to_scipy(self) -> ScipyMotion:
        """`.rotation(t)`, a SciPy `Rotation`, and `.easing(k)` of leg k, a `PPoly` of time from 0 to 1."""
        return ScipyMotion(self)


@dataclass(frozen=True)
class ArcDesign(Design):
    """The design of a tour."""

    @property
    def law(self) -> Law:
        """The law that was designed."""
        return Law.of(self.optimised.law)


@dataclass(frozen=True)
class CurveDesign(BezierDesign):
    """The design of a motion along Bézier curves."""

    @property
    def law(self) -> Law:
        """The law that was designed."""
        return Law.of(self.optimised.law)


def design(
    problem: str | Path | Mapping[str, Any], progress: Progress | None = None
) -> ArcDesign | CurveDesign:
    """Design the law of a problem file, or of a mapping that holds what such a file does.

    Raises:
        InputError: the problem, or a table it names, is wrong.
        InfeasibleError: no law was found.
    """
    path, model, source = _read_problem(problem)
    if model.route.bezier:
        return CurveDesign(**vars(design_curves(path, model, source, progress)))
    return ArcDesign(**vars(design_problem(path, model, source, progress)))


def load(path: str | Path) -> Law:
    """The law in a file.

    Raises:
        InputError: the file cannot be read, or is no law file.
    """
    return Law.of(read_law(Path(path))[0])


def _read_problem(problem: str | Path | Mapping[str, Any]) -> tuple[Path, Problem, Source]:
    if isinstance(problem, str | Path):
        return Path(problem), *load_problem(Path(problem))
    try:
        text = json.dumps(dict(problem), default=_plain, allow_nan=False, indent=1)
    except (TypeError, ValueError) as error:
        raise InputError(Fault(f"not what a problem file can hold: {error}", "", FROM_DICT)) from None
    source = read(text, FROM_DICT)
    return Path(FROM_DICT), check_problem(source), source


def _plain(value: Any) -> Any:
    """Arrays as lists, paths as texts."""
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    raise TypeError(f"{type(value).__name__} {value!r}")
