"""Laws that say other things of themselves than their motion shows."""

import json
from collections.abc import Iterator
from typing import Any

from tests.exact.broken import Broken, Document, _with
from tests.exact.documents import arc, document, quintic
from tests.exact.handmade import make_dwells, make_law
from timelaw.certificate import certify
from timelaw.export import format_law
from timelaw.law_file import from_document


def record(law: Document) -> Document:
    """The law with what the package says of it."""
    read = from_document(law)
    return json.loads(format_law(read, certify(read), {}))


def make_slow() -> Document:
    """A law whose limit is the least that a law may have."""
    return document([arc("1", "2", [quintic(1e-7, 1e3)], angle=1e-7)], {"velocity": 1e-9}, continuity=2)


def list_false_records() -> list[Broken]:
    """P8."""
    return [("P8", what, law) for what, law in _falsify()]


def _falsify() -> Iterator[tuple[str, Any]]:
    slow, law, rest = record(make_slow()), record(make_law()), record(make_dwells(1.0))
    yield "a bound of 1e-9 recorded as 0", _with(slow, certificate__limits__0__bound=0.0)
    yield "a small maximum recorded as 0", _with(slow, certificate__limits__0__upper=0.0)
    yield "a bound", _with(law, certificate__limits__1__bound=50 * (1 + 2e-9))
    yield "a maximum", _with(law, certificate__limits__1__upper=lambda upper: upper * (1 - 2e-9))
    yield "the name of a limit", _with(law, certificate__limits__1__limit="snap")
    yield "a limit left out", _with(law, certificate__limits=lambda limits: limits[1:])
    yield "holds", _with(law, certificate__holds=False)
    yield "the class", _with(law, certificate__continuity=3)
    yield "the class of a node", _with(rest, nodes__1__continuity=4)
    yield "the time of a node", _with(rest, nodes__2__time=2.1)
    yield "a node left out", _with(rest, nodes=lambda nodes: nodes[:-1])
    yield "the label of a node", _with(rest, nodes__1__label="3")
