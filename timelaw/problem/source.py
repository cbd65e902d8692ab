"""YAML 1.2 text → plain data, with the line and column of every key and value."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import Any

from ruamel.yaml.composer import ComposerError
from ruamel.yaml.error import MarkedYAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode
from ruamel.yaml.reader import ReaderError

from timelaw.errors import Fault, InputError, TimelawError, shorten
from timelaw.problem.composer import find_place, make_parser

KeyPath = tuple[str | int, ...]
Place = tuple[int, int]

WHOLE = "tag:yaml.org,2002:int"
_PLAIN = re.compile(r"-?(0|[1-9]\d*)")
_ITEMS = re.compile(r"(.*?)((?:\[\d{1,9}\])*)", re.ASCII | re.DOTALL)
MOST_DIGITS = 300  # of a whole number: beyond, no float holds it
MOST_HEX_DIGITS = 250  # 0x among them: no more than 300 of the others


@dataclass(frozen=True)
class Source:
    """Plain data of one document and where each part stands (line, column, both from 1).

    `numbers` are the values and keys that are whole numbers but not written as Python writes them, such
    as 001, as they are written.
    """

    data: Any
    text: str
    path: str
    keys: dict[KeyPath, tuple[int, int]]
    values: dict[KeyPath, tuple[int, int]]
    numbers: dict[KeyPath, str] = field(default_factory=dict)

    def fault(self, where: KeyPath, message: str, *, at_key: bool = False) -> Fault:
        """A fault at the key or the value of `where`, or at what encloses it if it is absent."""
        place = self.keys.get(where) if at_key else None
        parent = where
        while place is None and parent:
            place = self.values.get(parent)
            parent = parent[:-1]
        line, column = place or (1, 1)
        return Fault(message, write_path(where), self.path, line, column)

    @property
    def speaks_degrees(self) -> bool:
        """Whether the limits are written in degrees, as they are unless radians alone are used."""
        words = list(_texts(self.data.get("limits")))
        return not any("rad" in word for word in words) or any("deg" in w or "°" in w for w in words)

    def with_values(self, values: Mapping[str, Any]) -> "Source":
        """The same document with other values at dotted keys, which may be new."""
        data = deepcopy(self.data)
        for key, value in values.items():
            *parents, last = key.split(".")
            place = data
            for parent in parents:
                if not isinstance(place.get(parent), dict):
                    place[parent] = {}
                place = place[parent]
            place[last] = value
        return replace(self, data=data)

    @contextmanager
    def placed(self) -> Iterator[None]:
        """Give faults that are found after reading, and name a key of this file, their place in it."""
        try:
            yield
        except TimelawError as error:
            raise type(error)(*(self._placed(fault) for fault in error.faults)) from None

    def _placed(self, fault: Fault) -> Fault:
        if fault.path or not fault.where:
            return fault
        return self.fault(_path(fault.where), fault.message)


def _texts(data: Any) -> Iterator[str]:
    """All texts in plain data."""
    if isinstance(data, str):
        yield data
    for part in data.values() if isinstance(data, dict) else data if isinstance(data, list) else ():
        yield from _texts(part)


def write_path(path: KeyPath) -> str:
    """("a", 0, "b") → a[1].b: items are counted from 1, as people and lines are."""
    text = ""
    for part in path:
        text += f"[{part + 1}]" if isinstance(part, int) else f".{part}" if text else part
    return text


def _path(text: str) -> KeyPath:
    """What `write_path` makes a text of, as a path again."""
    parts: list[str | int] = []
    for part in text.split("."):
        match = _ITEMS.fullmatch(part)
        name, items = match.groups() if match is not None else (part, "")
        parts += [name, *(int(item) - 1 for item in re.findall(r"\d+", items))]
    return tuple(parts)


PROBLEM = 'problem file is a mapping that starts with "timelaw: 1"'


def read(text: str, path: str, kind: str = PROBLEM) -> Source:
    """Parse one YAML 1.2 document.

    Raises:
        InputError: not YAML, a duplicate key, more than one document, or not a mapping.
    """
    yaml = make_parser()
    try:
        node = yaml.compose(text)
        keys, values, numbers = _places(node, path)
        data = _with_text_keys(yaml.constructor.construct_document(node)) if node is not None else None
    except MarkedYAMLError as error:
        what = " ".join(str(part) for part in (error.context, error.problem) if part)
        raise InputError(_marked(error, f"not readable as YAML: {shorten(what)}", path)) from None
    except ReaderError as error:
        message = f"not readable as YAML: the character #x{error.character:04x} is not allowed"
        raise InputError(Fault(message, "", path, *find_place(text, error))) from None
    if not isinstance(data, dict):
        given = "an empty file" if data is None else f"a {_name(data)}"
        raise InputError(Fault(f"{given}; a {kind}", "", path, 1, 1))
    return Source(data, text, path, keys, values, numbers)


def _marked(error: MarkedYAMLError, message: str, path: str) -> Fault:
    mark = error.problem_mark or error.context_mark
    return Fault(message, "", path, mark.line + 1 if mark else 1, mark.column + 1 if mark else 1)


def _with_text_keys(data: Any) -> Any:
    """Keys as texts: labels of nodes may be written as numbers."""
    if isinstance(data, dict):
        return {str(key): _with_text_keys(value) for key, value in data.items()}
    return [_with_text_keys(value) for value in data] if isinstance(data, list) else data


def _places(
    node: Node | None, path: str
) -> tuple[dict[KeyPath, Place], dict[KeyPath, Place], dict[KeyPath, str]]:
    """Line and column of every key and of every value, both from 1; numbers that are written oddly."""
    numbers: dict[KeyPath, str] = {}
    keys: dict[KeyPath, Place] = {}
    values: dict[KeyPath, Place] = {}
    for where, key_node, value_node in _walk(node, ()) if node is not None else ():
        values[where] = _place(value_node)
        for one in (key_node, value_node):
            if one is not None and _is_huge(one):
                message = f"a whole number of more than {MOST_DIGITS} digits; none here is that large"
                raise InputError(Fault(message, write_path(where), path, *_place(one)))
        odd = next((one for one in (key_node, value_node) if one is not None and _is_odd(one)), None)
        if odd is not None:
            numbers[where] = odd.value
        if key_node is None:
            continue
        place = _place(key_node)
        if where in keys and keys[where] != place:
            raise InputError(Fault(f'duplicate key "{where[-1]}"', "", path, *place))
        keys[where] = place
    return keys, values, numbers


def _place(node: Node) -> Place:
    return node.start_mark.line + 1, node.start_mark.column + 1


def _is_huge(node: Node) -> bool:
    """A whole number that no float holds, on which arithmetic and text of Python fail."""
    if node.tag != WHOLE:
        return False
    digits = node.value.lstrip("+-").replace("_", "").lower()
    return len(digits) > (MOST_HEX_DIGITS if digits.startswith("0x") else MOST_DIGITS)


def _is_odd(node: Node) -> bool:
    """Whether it is a whole number that is not written as Python writes it."""
    return node.tag == WHOLE and not _PLAIN.fullmatch(node.value)


def _name(data: Any) -> str:
    return "list" if isinstance(data, list) else "single value"


def _walk(node: Node, path: KeyPath) -> Iterator[tuple[KeyPath, Node | None, Node]]:
    """Yield (path, key node, value node) of everything below `node`."""
    if isinstance(node, MappingNode):
        for key, value in node.value:
            if not isinstance(key, ScalarNode):
                raise ComposerError(None, None, "a key must be a text", key.start_mark)
            where = (*path, key.value)
            yield where, key, value
            yield from _walk(value, where)
    elif isinstance(node, SequenceNode):
        for index, value in enumerate(node.value):
            where = (*path, index)
            yield where, None, value
            yield from _walk(value, where)
