"""JSON Schema of problem files, for editors: from the model, with what it reads in other shapes, and words.

A schema sees shapes and names; what quantities must not be, and keys not say together, the program tells.
"""

from typing import Any

from pydantic import BaseModel

from timelaw.limits import LIMITS
from timelaw.problem.problem import Problem
from timelaw.problem.route import SOURCES
from timelaw.problem.schema_words import WORDS
from timelaw.units import MOST, UNIT_NAMES

DIALECT = "https://json-schema.org/draft/2020-12/schema"
TEXT: dict[str, Any] = {"type": "string"}
LABEL: dict[str, Any] = {"type": ["string", "integer"]}
NUMBER = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
FACTOR = rf"({'|'.join(sorted(UNIT_NAMES, key=len, reverse=True))})((\^|\*\*)[+-]?\d|[²³⁴])?"
UNITS = rf"{FACTOR}(\s*[*/·⋅]\s*{FACTOR})*"
QUANTITY: dict[str, Any] = {"type": "string", "pattern": rf"^\s*{NUMBER}\s*{UNITS}\s*$"}
UNSIGNED = NUMBER.removeprefix("[+-]?")
POSITIVE: dict[str, Any] = {"type": "string", "pattern": rf"^\s*\+?{UNSIGNED}\s*{UNITS}\s*$"}
NUMERIC = {"type": "number", "minimum": -MOST, "maximum": MOST}
PART: dict[str, Any] = {
    "anyOf": [{"type": "string", "pattern": rf"^\s*{NUMBER}\s*%?\s*$"}, {"type": "number"}],
    "examples": ["1 %"],
}
ZERO = {"const": 0}


def _rows(items: dict[str, Any], least: int, most: int | None = None) -> dict[str, Any]:
    found = {"type": "array", "items": items, "minItems": least}
    return found if most is None else found | {"maxItems": most}


NUMBERS = {"anyOf": [_rows(NUMERIC, 3, 16), _rows(_rows(NUMERIC, 3, 4), 3, 4)]}
UNIT = _rows(NUMERIC, 4, 4)
THREE = _rows({"anyOf": [QUANTITY, ZERO]}, 3, 3)
ONE_OR_THREE = {"anyOf": [QUANTITY, THREE]}
BOUNDS = {"anyOf": [POSITIVE, _rows(POSITIVE, 3, 3)]}
SHAPES: dict[str, dict[str, Any]] = {  # what validators read besides what the types say
    "Problem": {
        "motion": {"anyOf": [{"enum": ["arcs", "through"]}, {"$ref": "#/$defs/Motion"}]},
        "objective": {"anyOf": [{"const": "time"}, {"$ref": "#/$defs/Goal"}]},
    },
    "Orientations": {
        "list": _rows(NUMBERS, 2),
        "columns": {"anyOf": [_rows(TEXT, 1), _rows({"type": "integer", "minimum": 1}, 1)]},
        "symmetry": LABEL,
        "only": _rows(LABEL, 1),
    },
    "RouteModel": {
        "start": LABEL,
        "end": LABEL,
        "home": UNIT,
    },
    "Turned": {"world": UNIT, "body": UNIT},
    "EndRates": dict.fromkeys(("velocity", "acceleration", "jerk"), ONE_OR_THREE),
    "Nodes": {"start": {"anyOf": [{"const": "periodic"}, {"$ref": "#/$defs/EndRates"}]}},
    "Body": {
        "inertia": {"anyOf": [_rows(QUANTITY, 3, 3), _rows(THREE, 3, 3)]},
        "momentum": THREE,
        "shape": _rows(QUANTITY, 3, 3),
    },
    "Limits": dict.fromkeys(LIMITS, BOUNDS),
    "EasingModel": {"within": PART},
    "Goal": {
        "total_time": {
            "anyOf": [QUANTITY, {"type": "string", "pattern": rf"^\s*{NUMBER} x minimum$"}],
            "examples": ["60 s", "1.5 x minimum"],
        }
    },
    "BezierModel": {
        "quaternions": _rows(NUMBERS, 2, 8),
        "points": _rows(THREE, 1, 8),
        "weights": _rows({"type": "number", "exclusiveMinimum": 0}, 2, 8),
    },
}


TOGETHER: dict[str, dict[str, Any]] = {  # what keys of one mapping must say
    "Orientations": {"oneOf": [{"required": [key]} for key in SOURCES]},
    "RouteModel": {"anyOf": [{"required": ["orientations"]}, {"required": ["bezier"]}]},
    "Limits": {"minProperties": 1},
    "Body": {"minProperties": 1},
}


def make_problem_schema() -> dict[str, Any]:
    """The schema of problem files, version 1."""
    found = describe_model(Problem, SHAPES)
    tours = found["$defs"]["RouteModel"]["properties"]["tour"]
    tours["anyOf"][1] = _rows(LABEL, 2)
    for name, rule in TOGETHER.items():
        found["$defs"][name] |= rule
    return {"$schema": DIALECT, "title": "timelaw problem file", **found}


def describe_model(model: type[BaseModel], shapes: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The JSON Schema of a model, each key with a description, other shapes put in, no defaults in SI."""
    found = model.model_json_schema()
    for name, part in {model.__name__: found, **found.get("$defs", {})}.items():
        part.pop("title", None)
        part.pop("description", None)  # which is for readers of the code
        for key, value in part.get("properties", {}).items():
            shape = shapes.get(name, {}).get(key)
            part["properties"][key] = {"description": WORDS[name][key], **_plain(shape or value)}
    return found


def _plain(value: dict[str, Any]) -> dict[str, Any]:
    """Without titles, defaults and null: a key that says nothing is left away; quantities have a unit."""
    if value.get("type") == "string" and value.get("examples") and "pattern" not in value:
        value = {**QUANTITY, "examples": value["examples"]}
    options = [option for option in value.get("anyOf", ()) if option != {"type": "null"}]
    kept = {k: v for k, v in value.items() if k not in ("anyOf", "default", "title", "description")}
    if len(options) == 1:
        return {**kept, **options[0]}
    return {**kept, "anyOf": options} if options else kept
