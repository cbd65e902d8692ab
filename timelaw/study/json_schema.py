"""JSON Schema of study files, for editors."""

from typing import Any

from timelaw.problem.json_schema import DIALECT, describe_model
from timelaw.study.study import MOST_DESIGNS, MOST_KEYS, StudyModel

SCALAR = {"type": ["string", "number"]}
RANGE = {
    "type": "object",
    "properties": {
        "from": {"description": "first value", **SCALAR},
        "to": {"description": "last value, with the same unit", **SCALAR},
        "steps": {
            "description": "how many, evenly spaced",
            "type": "integer",
            "minimum": 2,
            "maximum": MOST_DESIGNS,
        },
    },
    "required": ["from", "to", "steps"],
    "additionalProperties": False,
}
VARIED = {
    "type": "object",
    "minProperties": 1,
    "maxProperties": MOST_KEYS,
    "additionalProperties": {"anyOf": [{"type": "array", "minItems": 1}, RANGE]},
}


def make_study_schema() -> dict[str, Any]:
    """The schema of study files, version 1."""
    found = describe_model(StudyModel, {"StudyModel": {"vary": VARIED}})
    return {"$schema": DIALECT, "title": "timelaw study file", **found}
