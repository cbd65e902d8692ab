"""`timelaw schema`: JSON Schema of problem and study files, which editors check and complete by."""

import json
import sys
from pathlib import Path
from typing import Any

from timelaw.cli.console import say
from timelaw.errors import EXIT_DONE
from timelaw.files import write_text
from timelaw.interrupts import finish_work
from timelaw.problem.json_schema import make_problem_schema


def _make_study_schema() -> dict[str, Any]:
    """Studies load all that designs them, which takes a second."""
    from timelaw.study.json_schema import make_study_schema

    return make_study_schema()


SCHEMAS = {"problem": make_problem_schema, "study": _make_study_schema}


def run(kind: str, output: str | None) -> int:
    """Print or write the schema of a kind of file; returns the exit code."""
    text = format_schema(kind)
    if output is None:
        with finish_work():
            sys.stdout.write(text)
            sys.stdout.flush()
        return EXIT_DONE
    write_text(Path(output), text)
    say(f"{output}: in a {kind} file, # yaml-language-server: $schema={Path(output).name}")
    return EXIT_DONE


def format_schema(kind: str) -> str:
    """The schema as a text."""
    return json.dumps(SCHEMAS[kind](), indent=1, ensure_ascii=False) + "\n"
