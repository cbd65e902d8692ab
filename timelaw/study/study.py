"""The study file: which problem, which of its keys are varied, and over what."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from math import prod
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, ValidationError

from timelaw.errors import InputError, shorten
from timelaw.objectives import EFFORTS
from timelaw.problem import Source
from timelaw.problem.fields import Model, fault, one_of, quote
from timelaw.problem.load import read_source, translate
from timelaw.units import LONGEST

MOST_DESIGNS = 10_000
MOST_KEYS = 50  # that are varied: each by two values already makes more designs than are allowed
LARGEST = 1e300  # differences of such numbers are finite
STUDY = 'study file is a mapping that starts with "timelaw-study: 1"'
WITH_UNIT = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*)")


def _values(value: Any) -> tuple[Any, ...]:
    """A list of values, or {from, to, steps}: evenly spaced, with the unit of both ends."""
    if isinstance(value, list) and value:
        return tuple(value)
    if not isinstance(value, dict) or set(value) != {"from", "to", "steps"}:
        raise fault('a list of values or a range {from: …, to: …, steps: …} is needed, as in "limits.jerk"')
    steps = value["steps"]
    if not isinstance(steps, int) or isinstance(steps, bool) or not 2 <= steps <= MOST_DESIGNS:
        raise fault(f"steps: {quote(steps)}; a whole number from 2 to {MOST_DESIGNS} is needed")
    given = f"from {shorten(str(value['from']))} to {shorten(str(value['to']))}"
    ends = [WITH_UNIT.fullmatch(str(value[end]).strip()[:LONGEST]) for end in ("from", "to")]
    if ends[0] is None or ends[1] is None or ends[0].group(2) != ends[1].group(2):
        raise fault(f"{given}; both need a number and the same unit")
    unit, first, last = ends[0].group(2), float(ends[0].group(1)), float(ends[1].group(1))
    if not max(abs(first), abs(last)) <= LARGEST:
        raise fault(f"{given}; numbers up to {LARGEST:g} are allowed")
    numbers = np.linspace(first, last, steps)
    if unit:
        return tuple(f"{number:.12g} {unit}" for number in numbers)
    return tuple(int(number) if float(number).is_integer() else float(number) for number in numbers)


class StudyModel(Model):
    """A study file, version 1."""

    study: Annotated[Literal[1], Field(alias="timelaw-study")]
    name: Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]*$", max_length=100)]
    problem: str
    vary: Annotated[
        dict[str, Annotated[tuple[Any, ...], BeforeValidator(_values)]],
        Field(min_length=1, max_length=MOST_KEYS),
    ]
    effort: Annotated[str, one_of(EFFORTS)] = "jerk"


@dataclass(frozen=True)
class Study:
    """The varied keys with their values, and the source of the problem file they are put into."""

    name: str
    path: Path
    base: Source
    vary: dict[str, tuple[Any, ...]]
    effort: str
    source: Source

    @property
    def size(self) -> int:
        """How many designs there are."""
        return prod(len(values) for values in self.vary.values())

    def points(self) -> Iterator[dict[str, Any]]:
        """Every combination of the varied values, the last key varying fastest."""
        for values in product(*self.vary.values()):
            yield dict(zip(self.vary, values, strict=True))


def read_study(path: Path) -> Study:
    """Read a study file and the problem file it names, which stands beside it.

    Raises:
        InputError: either file is wrong.
    """
    source = read_source(path, "a study file", STUDY)
    try:
        model = StudyModel.model_validate(source.data)
    except ValidationError as error:
        raise InputError(*translate(source, error, StudyModel)) from None
    problem = path.parent / model.problem
    base = read_source(problem, "a problem file")
    study = Study(model.name, problem, base, dict(model.vary), model.effort, source)
    for one in study.vary:
        inside = next((other for other in study.vary if other.startswith(f"{one}.")), None)
        if inside is not None:
            message = f'"{inside}" is a part of "{one}"; vary one of them'
            raise InputError(source.fault(("vary", one), message, at_key=True))
    if study.size > MOST_DESIGNS:
        message = f"{study.size} designs; at most {MOST_DESIGNS} are made"
        raise InputError(source.fault(("vary",), message))
    return study
