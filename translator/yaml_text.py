"""Reads YAML of users with the place of every value; aliases, tags and huge documents are refused."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Final, cast

import yaml

from translator.limits import YAML_BYTES, YAML_LEVELS, YAML_VALUES
from translator.yaml_core import CoreLoader, core_value

_TAGS: Final = frozenset(
    f"tag:yaml.org,2002:{name}" for name in ("str", "int", "float", "bool", "null", "seq", "map")
)

Path = tuple[str | int, ...]


class YamlError(ValueError):
    """A document cannot be read; `line` and `column` count from 1."""

    def __init__(self, message: str, line: int = 1, column: int = 1) -> None:
        super().__init__(message)
        self.message = message
        self.line = line
        self.column = column


@dataclass(slots=True)
class YamlText:
    """A document, with line and column of each of its parts."""

    value: Any = None
    places: dict[Path, tuple[int, int]] = field(default_factory=dict)

    def place(self, path: Path) -> tuple[int, int]:
        """Returns line and column of a part, or of the nearest enclosing part that exists."""
        while path not in self.places and path:
            path = path[:-1]
        return self.places.get(path, (1, 1))


def read_yaml(raw: bytes) -> YamlText:
    """Reads one YAML document.

    Raises:
        YamlError: it is not YAML, or uses a feature that is refused.
    """
    if len(raw) > YAML_BYTES:
        raise YamlError(f"the document is larger than {YAML_BYTES} bytes")
    try:
        text = raw.decode("utf-8-sig")
        _measure(text)
        root = yaml.compose(text, Loader=CoreLoader)
    except UnicodeDecodeError as error:
        raise YamlError("the document is not UTF-8", raw.count(b"\n", 0, error.start) + 1) from None
    except yaml.MarkedYAMLError as error:
        raise _at(error.problem_mark, str(error.problem or error)) from None
    except yaml.YAMLError as error:
        raise YamlError(str(error).splitlines()[0]) from None
    if root is None:
        raise YamlError("the document is empty")
    found = YamlText()
    found.value = _read(root, (), found.places)
    return found


def _at(mark: Any, message: str) -> YamlError:
    return YamlError(message, mark.line + 1, mark.column + 1) if mark else YamlError(message)


def _measure(text: str) -> None:
    """Refuses YAML that is too deep, too long or has aliases, before any object is built."""
    depth = values = 0
    for event in yaml.parse(text, Loader=CoreLoader):
        mark = event.start_mark
        if isinstance(event, yaml.AliasEvent):
            raise _at(mark, "aliases (*name) have no place here: write the value again")
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1
        if depth > YAML_LEVELS:
            raise _at(mark, f"the document is nested deeper than {YAML_LEVELS}")
        values += isinstance(event, yaml.NodeEvent)
        if values > YAML_VALUES:
            raise _at(mark, f"the document has more than {YAML_VALUES} values")


def _read(node: yaml.Node, path: Path, places: dict[Path, tuple[int, int]]) -> Any:
    mark = node.start_mark
    if node.tag not in _TAGS:
        raise _at(
            mark, f"values of the type {node.tag.rpartition(':')[2]} have no place here: put it in quotes"
        )
    places[path] = (mark.line + 1, mark.column + 1)
    if isinstance(node, yaml.SequenceNode):
        return [_read(child, (*path, index), places) for index, child in enumerate(node.value)]
    if isinstance(node, yaml.MappingNode):
        held: dict[str, Any] = {}
        for key, child in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise _at(key.start_mark, "a key must be a word")
            if key.value in held:
                raise _at(key.start_mark, f"the key '{key.value}' appears twice")
            held[key.value] = _read(child, (*path, key.value), places)
            places[*path, key.value] = (key.start_mark.line + 1, key.start_mark.column + 1)
        return held
    try:
        return core_value(cast("yaml.ScalarNode", node))
    except ValueError as error:
        raise _at(mark, f"this value cannot be read: {str(error).splitlines()[0]}") from None
