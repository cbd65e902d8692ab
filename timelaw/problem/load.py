"""Read a problem file; say of every fault where it is, what was given and what is allowed."""

from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from timelaw.errors import Fault, InputError, list_first, shorten
from timelaw.files import read_start, read_text
from timelaw.problem.fields import quote, suggest
from timelaw.problem.forms import SEQUENCE
from timelaw.problem.problem import NAME, Problem
from timelaw.problem.source import PROBLEM, KeyPath, Source, read

VERSION = 1
LAW_MARK = b'"timelaw-law"'  # in the first line of a law file, and in no other
BEYOND = 10**9  # the line after which faults without one are listed
LABELLED: tuple[KeyPath, ...] = (("route", "tour"), ("nodes", "at"))  # lists and mappings of labels
LABELS: tuple[KeyPath, ...] = (("route", "start"), ("route", "end"))


def load_problem(path: Path) -> tuple[Problem, Source]:
    """Read and check the problem file at `path`; the source knows the place of every key.

    Raises:
        InputError: with one fault per line, each with file:line:column.
    """
    source = read_source(path, "a problem file")
    return check_problem(source), source


def read_source(path: Path, wanted: str, kind: str = PROBLEM) -> Source:
    """The source at `path` of one of `FILES`, the one that is wanted.

    Raises:
        InputError: it cannot be read, or is of another kind.
    """
    if LAW_MARK in read_start(path):  # which may be long, and takes YAML a while
        message = _name_use("a law file", wanted, str(path))
        raise InputError(Fault(message, "", str(path), 1, 1))
    source = read(read_text(path), str(path), kind)
    refuse_other_kinds(source, wanted)
    return source


FILES = {  # by what they are: the command that takes them
    "a law file": "timelaw verify",
    "a study file": "timelaw sweep",
    "a problem file": "timelaw design",
}


def refuse_other_kinds(source: Source, wanted: str) -> None:
    """Say in one sentence that a file is of another kind, where its keys show it.

    Raises:
        InputError: it is one of `FILES`, but not the one that is wanted.
    """
    data = source.data
    marks = (data.get("format") == "timelaw-law", "timelaw-study" in data, "timelaw" in data)
    kind = next((kind for kind, there in zip(FILES, marks, strict=True) if there), wanted)
    if kind != wanted:
        raise InputError(source.fault((), _name_use(kind, wanted, source.path)))


def _name_use(kind: str, wanted: str, path: str) -> str:
    return f"this is {kind}, not {wanted}; use it with: {FILES[kind]} {path}"


def parse_problem(text: str, path: str = "<problem>") -> Problem:
    """Check the text of a problem file; `path` is named in the messages."""
    return check_problem(read(text, path))


def check_problem(source: Source) -> Problem:
    """The problem that a source holds.

    Raises:
        InputError: with one fault per line, each with its place.
    """
    version = source.data.get("timelaw")
    if "timelaw" in source.data and (version != VERSION or isinstance(version, bool)):
        message = f"{quote(version)}; this program reads problem files of version {VERSION}"
        raise InputError(source.fault(("timelaw",), message))
    refuse_numbers_for_labels(source)
    try:
        return Problem.model_validate(source.data)
    except ValidationError as error:
        raise InputError(*translate(source, error, Problem)) from None


def refuse_numbers_for_labels(source: Source) -> None:
    """Say that a label such as 001 has to be quoted, which YAML reads as the number 1.

    Raises:
        InputError: labels that are whole numbers, written in another way than numbers are.
    """
    faults = []
    for where, text in source.numbers.items():
        if where[:-1] in LABELLED or where in LABELS:
            hint = f'write "{text}" if that is the label'
            message = f"{text} without quotes is the number {int(text.replace('_', ''), _base(text))}; {hint}"
            faults.append(source.fault(where, message, at_key=where[:-1] == ("nodes", "at")))
    if faults:
        raise InputError(*list_first(faults, len(faults), source.path))


def _base(text: str) -> int:
    """Of a whole number in YAML 1.2."""
    return {"0o": 8, "0x": 16, "0b": 2}.get(text.lstrip("+-")[:2].lower(), 10)


def translate(source: Source, error: ValidationError, model: type[BaseModel]) -> list[Fault]:
    """What a model says is wrong, with places in the source and in our words, in the order of the file."""
    found = (_fault(source, details, model) for details in error.errors(include_url=False))
    faults = list_first(found, error.error_count(), source.path)
    return sorted(faults, key=lambda f: (f.line or BEYOND, f.column or 0))


def _fault(source: Source, details: ErrorDetails, model: type[BaseModel]) -> Fault:
    where = _in_data(source.data, details["loc"])
    kind, given, context = details["type"], details["input"], details.get("ctx", {})
    if kind == "extra_forbidden":
        fields = _model_at(model, where[:-1]).model_fields
        allowed = suggest(where[-1], [field.alias or name for name, field in fields.items()])
        return source.fault(where[:-1], f'unknown key "{shorten(str(where[-1]))}"; allowed: {allowed}').at(
            source.keys.get(where)
        )
    if kind == "missing":
        return source.fault(where[:-1], f'missing key "{where[-1]}"')
    if kind == "timelaw":
        return source.fault((*where, *context["where"]), details["msg"])
    return source.fault(where, f"{quote(given)}; {_expectation(kind, given, context, details['msg'])}")


PATTERNS = {
    NAME: "letters, digits, '.', '_' and '-' are allowed, a letter or digit first",
    SEQUENCE: "three of X, Y, Z, which turn with the body, or three of x, y, z about fixed axes are needed",
}


def _expectation(kind: str, given: Any, context: dict[str, Any], message: str) -> str:
    """What is allowed instead, in the words of this program."""
    if kind == "literal_error":
        options = context["expected"].replace(" or ", ", ").replace("'", "").split(", ")
        return f"allowed: {suggest(given, options)}"
    return {
        "bool_type": "allowed: true, false",
        "int_type": "a whole number is needed",
        "string_type": "a text is needed",
        "model_type": "a mapping of keys and values is needed",
        "dict_type": "a mapping of keys and values is needed",
        "greater_than": f"more than {context.get('gt')} is needed",
        "float_type": "a number is needed",
        "tuple_type": "a list is needed",
        "greater_than_equal": f"at least {context.get('ge')} is needed",
        "less_than_equal": f"at most {context.get('le')} is allowed",
        "string_too_long": f"at most {context.get('max_length')} characters are allowed",
        "string_pattern_mismatch": PATTERNS.get(context.get("pattern", ""), message),
    }.get(kind, message)


def _in_data(data: Any, location: KeyPath) -> KeyPath:
    """The part of pydantic's location that stands in the file, without the names of union members."""
    path: list[str | int] = []
    for index, part in enumerate(location):
        inside = isinstance(data, dict) or (isinstance(data, list) and isinstance(part, int))
        if not inside or (isinstance(data, dict) and part not in data and index < len(location) - 1):
            continue
        path.append(part)
        data = data.get(part) if isinstance(data, dict) else data[int(part)]
    return tuple(path)


def _model_at(model: type[BaseModel], path: KeyPath) -> type[BaseModel]:
    """The model that describes the mapping at `path`."""
    for part in path:
        field = model.model_fields.get(str(part))
        found = _models_in(field.annotation) if field else [model]
        model = found[0] if found else model
    return model


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    """The models that an annotation such as `X | None` or `dict[str, X]` holds."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in _models_in(part)]
