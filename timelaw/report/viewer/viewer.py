"""The section's style, script and data, ready to stand in a page that needs nothing else."""

import json
from functools import cache
from importlib.resources import files
from typing import Any

from markupsafe import Markup

from timelaw.certificate import Certificate
from timelaw.limits.body import WHEELS
from timelaw.motion import QuaternionLaw
from timelaw.report.viewer.numbers import RECORDS, tabulate_segments
from timelaw.report.viewer.used_limits import list_used_limits

SCRIPTS = ("segments", "law", "scene", "body", "player")  # in the order in which they are read


def make_viewer(law: QuaternionLaw, certificate: Certificate) -> dict[str, Any]:
    """What the template of the motion is filled with."""
    return {
        "style": Markup(_read("motion.css")),
        "script": Markup(_join_scripts()),
        "data": Markup(_write_json(list_data(law, certificate))),
        "travels": law.travels,
    }


def list_data(law: QuaternionLaw, certificate: Certificate) -> dict[str, Any]:
    """The law as the script reads it."""
    numbers, segments = tabulate_segments(law)
    body = law.body
    return {
        "duration": law.duration,
        "kinds": list(RECORDS),
        "labels": list(law.labels),
        "travels": law.travels,
        "shape": law.shape,
        "body": body
        and {
            "inertia": body.inertia.tolist(),
            "wheels": body.actuator == WHEELS,
            "momentum": body.momentum.tolist(),
        },
        "limits": list_used_limits(law, certificate),
        "segments": segments,
        "numbers": numbers,
    }


def _write_json(data: dict[str, Any]) -> str:
    """As text of a script element, which nothing in it can end."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


@cache
def _read(name: str) -> str:
    return (files("timelaw.report.viewer") / "assets" / name).read_text("utf-8").strip()


@cache
def _join_scripts() -> str:
    """All of them in one function, so that the page knows none of their names."""
    parts = "\n".join(_read(f"{name}.js") for name in SCRIPTS)
    return f'(() => {{\n"use strict";\n{parts}\n}})();'
