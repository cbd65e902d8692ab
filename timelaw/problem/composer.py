"""YAML text → nodes and plain data, within bounds: a few bytes blow nothing up, refusals have their place."""

from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.composer import Composer, ComposerError
from ruamel.yaml.constructor import ConstructorError, SafeConstructor
from ruamel.yaml.events import AliasEvent, Event, ScalarEvent
from ruamel.yaml.nodes import Node
from ruamel.yaml.reader import ReaderError
from ruamel.yaml.scanner import Scanner, ScannerError

MOST_VALUES = 100_000  # and keys, aliases written out: 5 s; 5000 rotation matrices are half of it
DEEPEST = 50  # lists and mappings inside each other; problem files need six
MERGE, DATE = "tag:yaml.org,2002:merge", "tag:yaml.org,2002:timestamp"
VERSIONS = (None, (1, 2))
# beside its own errors the parser lets those of Python out: escapes beyond Unicode, versions of 5000 digits
OTHERS = (ValueError, LookupError, ArithmeticError)


class PlainScanner(Scanner):
    """Refuses tags where they begin: no file here needs one, and reading a long one takes a while."""

    def fetch_tag(self) -> None:
        """A tag comes next."""
        message = "a tag (!…); none is needed: a text stands in quotes, a number without"
        raise ScannerError(None, None, message, self.reader.get_mark())


class BoundedComposer(Composer):
    """Counts what it composes, an alias as all that it stands for, and refuses what no file here needs."""

    def __init__(self, loader: Any = None) -> None:
        super().__init__(loader)
        self.warn_double_anchors = False  # a name may be given again
        self.count, self.level = 0, 0
        self.sizes: dict[int, tuple[int, int]] = {}  # by node: values in it, and how deep they are

    def get_single_node(self) -> Any:
        """The document, if there is one."""
        try:
            return super().get_single_node()
        except OTHERS:
            message = "an escape or directive here has a number that is out of range"
            raise ComposerError(None, None, message, self.loader.reader.get_mark()) from None

    def compose_document(self) -> Any:
        """The one document, of YAML 1.2."""
        event = self.parser.peek_event()
        if event.version not in VERSIONS:
            raise ComposerError(None, None, "YAML 1.2 is read, no other version", event.start_mark)
        return super().compose_document()

    def compose_node(self, parent: Any, index: Any) -> Any:
        """A value with all that is in it."""
        event, before = self.parser.peek_event(), self.count
        _refuse_halves(event)
        self.level += 1
        self._refuse_more(1, event)
        node = super().compose_node(parent, index)
        if isinstance(event, AliasEvent):
            if id(node) not in self.sizes:
                raise ComposerError(None, None, "an alias repeats the part it stands in", event.start_mark)
            size, height = self.sizes[id(node)]
            self.count += size
        else:
            self.count += 1
            height = 1 + max((self.sizes[id(child)][1] for child in _children(node)), default=0)
            self.sizes[id(node)] = self.count - before, height
        self._refuse_more(height, event)
        self.level -= 1
        if node.tag == MERGE:
            message = "a merge key (<<); write the keys that it stands for out here"
            raise ComposerError(None, None, message, event.start_mark)
        return node

    def _refuse_more(self, height: int, event: Event) -> None:
        """Too many values, or too deep ones."""
        if self.count > MOST_VALUES:
            message = f"more than {MOST_VALUES} keys and values; orientations may stand in a table (file: …)"
            raise ComposerError(None, None, message, event.start_mark)
        if self.level + height - 1 > DEEPEST:
            message = f"nested too deeply; {DEEPEST} lists and mappings inside each other are allowed"
            raise ComposerError(None, None, message, event.start_mark)


def _children(node: Node) -> list[Node]:
    """What stands in a list or mapping; nothing stands in a single value."""
    if isinstance(node.value, str):
        return []
    return [part for child in node.value for part in (child if isinstance(child, tuple) else (child,))]


def _refuse_halves(event: Event) -> None:
    """Characters that are none."""
    if isinstance(event, ScalarEvent) and any("\ud800" <= character <= "\udfff" for character in event.value):
        message = "half a surrogate pair is no character; write the character itself"
        raise ComposerError(None, None, message, event.start_mark)


class PlainConstructor(SafeConstructor):
    """Plain data; a date is a text, for labels may look like dates."""

    def construct_object(self, node: Any, deep: bool = False) -> Any:
        """The value of a node."""
        try:
            return super().construct_object(node, deep)
        except OTHERS:
            message = f'"{node.value}" is no number; a text that looks like one stands in quotes'
            raise ConstructorError(None, None, message, node.start_mark) from None


PlainConstructor.add_constructor(DATE, SafeConstructor.construct_yaml_str)


def make_parser() -> YAML:
    """A parser whose `compose` gives the nodes of one document and whose `constructor` their plain data."""
    yaml = YAML(typ="safe", pure=True)
    yaml.Scanner = PlainScanner
    yaml.Composer, yaml.Constructor = BoundedComposer, PlainConstructor
    return yaml


def find_place(text: str, error: ReaderError) -> tuple[int, int]:
    """Line and column, both from 1, of a character that is not allowed."""
    before = text[: error.position]
    return before.count("\n") + 1, error.position - before.rfind("\n")
