"""YAML 1.2 text → plain data, with the line and column of every key and value."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.composer import ComposerError
from ruamel.yaml.error import MarkedYAMLError, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from timelaw.errors import Fault, InputError, TimelawError

KeyPath = tuple[str | int, ...]
Place = tuple[int, int]

WHOLE = "tag:yaml.org,2002:int"
_PLAIN = re.compile(r"-?(0|[1-9]\d*)")
_ITEM = re.compile(r"\[\d+\]$")
MOST_DIGITS = 300  # of a whole number: beyond, no float holds it
MOST_VALUES = 500_000  # a few bytes of aliases can stand for more than memory holds


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
        name, *items = part.split("[")
        parts += [name, *(int(item.rstrip("]")) - 1 for item in items)] if _ITEM.search(part) else [part]
    return tuple(parts)


PROBLEM = 'problem file is a mapping that starts with "timelaw: 1"'


def read(text: str, path: str, kind: str = PROBLEM) -> Source:
    """Parse one YAML 1.2 document.

    Raises:
        InputError: not YAML, a duplicate key, more than one document, or not a mapping.
    """
    yaml = YAML(typ="safe", pure=True)
    try:
        node = yaml.compose(text)
        _refuse_cycles(node, (), set())
        keys, values, numbers = _places(node, path)
        data = _with_text_keys(yaml.load(text))
        huge = next((where for where, value in _list_values(data, ()) if _is_huge(value)), None)
    except MarkedYAMLError as error:
        what = " ".join(str(part) for part in (error.context, error.problem) if part)
        raise InputError(_marked(error, f"not readable as YAML: {what}", path)) from None
    except RecursionError:
        raise InputError(Fault("not readable as YAML: nested too deeply", "", path, 1, 1)) from None
    except (YAMLError, ValueError, LookupError, TypeError, AttributeError, ArithmeticError) as error:
        # besides its own errors the parser lets those of Python out, for odd tags and keys
        what = (str(error).strip().splitlines() or [type(error).__name__])[0]
        raise InputError(Fault(f"not readable as YAML: {what}", "", path, 1, 1)) from None
    if huge is not None:
        message = f"a whole number of more than {MOST_DIGITS} digits; none here is that large"
        raise InputError(Fault(message, write_path(huge), path, *values.get(huge, (1, 1))))
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


def _list_values(data: Any, path: KeyPath) -> Iterator[tuple[KeyPath, Any]]:
    """Every single value in plain data, and its path."""
    parts = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else None
    if parts is None:
        yield path, data
    for key, value in parts or ():
        yield from _list_values(value, (*path, key))


def _is_huge(value: Any) -> bool:
    """A whole number that no float holds, on which arithmetic and text of Python fail."""
    return isinstance(value, int) and abs(value) >= 10**MOST_DIGITS


def _refuse_cycles(node: Node | None, ancestors: tuple[int, ...], done: set[int]) -> None:
    """An alias may repeat a part of the file, but not the part it stands in."""
    if node is not None and id(node) in ancestors:
        raise ComposerError(None, None, "an alias repeats the part it stands in", node.start_mark)
    if id(node) in done or not isinstance(node, MappingNode | SequenceNode):
        return
    for child in node.value:
        for part in child if isinstance(child, tuple) else (child,):
            _refuse_cycles(part, (*ancestors, id(node)), done)
    done.add(id(node))


def _places(
    node: Node | None, path: str
) -> tuple[dict[KeyPath, Place], dict[KeyPath, Place], dict[KeyPath, str]]:
    """Line and column of every key and of every value, both from 1; numbers that are written oddly."""
    numbers: dict[KeyPath, str] = {}
    keys: dict[KeyPath, Place] = {}
    values: dict[KeyPath, Place] = {}
    for where, key_node, value_node in _walk(node, ()) if node is not None else ():
        if len(values) == MOST_VALUES:
            raise ComposerError(None, None, f"more than {MOST_VALUES} values", value_node.start_mark)
        values[where] = (value_node.start_mark.line + 1, value_node.start_mark.column + 1)
        odd = next((one for one in (key_node, value_node) if one is not None and _is_odd(one)), None)
        if odd is not None:
            numbers[where] = odd.value
        if key_node is None:
            continue
        place = (key_node.start_mark.line + 1, key_node.start_mark.column + 1)
        if where in keys and keys[where] != place:
            raise InputError(Fault(f'duplicate key "{where[-1]}"', "", path, *place))
        keys[where] = place
    return keys, values, numbers


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
