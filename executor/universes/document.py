"""Reads YAML documents with the line of every value; tags and huge documents are refused."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import yaml

from translator.yaml_core import CoreLoader, core_value

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_BYTES: Final = 2_000_000
MAX_NODES: Final = 100_000
MAX_DEPTH: Final = 32
TAGS: Final = frozenset(
    f"tag:yaml.org,2002:{name}" for name in ("str", "int", "float", "bool", "null", "seq", "map", "timestamp")
)

Path = tuple[str | int, ...]


@dataclass(frozen=True)
class Problem:
    """An error at a place of a document; lines and columns count from 1."""

    message: str
    line: int = 1
    column: int = 1
    code: str = "BTU001"
    hint: str = ""

    def __str__(self) -> str:
        hint = f" ({self.hint})" if self.hint else ""
        return f"{self.line}:{self.column}: {self.code} {self.message}{hint}"


class DocumentError(Exception):
    """A document cannot be read; `problems` hold the reasons and their places."""

    def __init__(self, problems: list[Problem], file: str = "") -> None:
        self.problems = problems
        self.file = file
        super().__init__("\n".join(f"{file}:{problem}" if file else str(problem) for problem in problems))


@dataclass(frozen=True)
class Located:
    """The value of a document, with the place of each of its parts."""

    value: Any
    places: dict[Path, tuple[int, int]]

    def place(self, path: Path) -> tuple[int, int]:
        """Returns line and column of a part, or of the nearest enclosing part that exists."""
        while path not in self.places and path:
            path = path[:-1]
        return self.places.get(path, (1, 1))


def text_of(raw: bytes, file: str = "") -> str:
    """Returns the text of a document.

    Raises:
        DocumentError: it is not UTF-8.
    """
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise DocumentError([Problem("the document is not UTF-8", line)], file) from error


def read_yaml(text: str, file: str = "", *, as_ros: bool = False) -> Located:
    """Reads one YAML document, by the core schema of YAML 1.2.

    Args:
        text: the document.
        file: its name in errors.
        as_ros: whether it is a file of ROS, which reads YAML 1.1.

    Raises:
        DocumentError: the text is not YAML, or uses a feature that is refused.
    """
    if len(text) > MAX_BYTES:
        raise DocumentError([Problem(f"the document is larger than {MAX_BYTES} bytes", code="BTU002")], file)
    try:
        _measure(text, file)
        root = yaml.compose(text, Loader=yaml.CSafeLoader if as_ros else CoreLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
        raise DocumentError([Problem(str(error.problem or error), line, column)], file) from error
    except yaml.YAMLError as error:
        raise DocumentError([Problem(str(error).splitlines()[0])], file) from error
    if root is None:
        raise DocumentError([Problem("the document is empty")], file)
    reader = _Reader(file, as_ros=as_ros)
    return Located(reader.read(root, ()), reader.places)


def _measure(text: str, file: str) -> None:
    """Refuses deeply nested documents before anything recurses into them."""
    depth = 0
    for event in yaml.parse(text, Loader=yaml.CSafeLoader):
        if isinstance(event, yaml.CollectionStartEvent):
            depth += 1
            if depth > MAX_DEPTH:
                mark = event.start_mark
                line, column = (mark.line + 1, mark.column + 1) if mark else (1, 1)
                problem = Problem(f"the document is nested deeper than {MAX_DEPTH}", line, column)
                raise DocumentError([problem], file)
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


class _Reader:
    def __init__(self, file: str, *, as_ros: bool) -> None:
        self.places: dict[Path, tuple[int, int]] = {}
        self._file = file
        self._value: Callable[[Any], Any] = yaml.SafeLoader("").construct_object if as_ros else core_value

    def read(self, node: yaml.Node, path: Path) -> Any:
        self._guard(node, path)
        self.places[path] = (node.start_mark.line + 1, node.start_mark.column + 1)
        if isinstance(node, yaml.SequenceNode):
            return [self.read(child, (*path, i)) for i, child in enumerate(node.value)]
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, path)
        return self._scalar(node)

    def _mapping(self, node: yaml.MappingNode, path: Path) -> dict[str, Any]:
        result: dict[str, Any] = {}
        for key_node, child in node.value:
            if not isinstance(key_node, yaml.ScalarNode):
                raise self._error(key_node, "a key must be a word")
            if key_node.value in result:
                raise self._error(key_node, f"the key {key_node.value!r} appears twice")
            result[key_node.value] = self.read(child, (*path, key_node.value))
        return result

    def _scalar(self, node: yaml.Node) -> Any:
        try:
            return self._value(node)
        except (yaml.YAMLError, ValueError, KeyError, AttributeError) as error:  # the last two of YAML 1.1
            raise self._error(node, f"this value cannot be read: {str(error).splitlines()[0]}") from error

    def _guard(self, node: yaml.Node, path: Path) -> None:
        if len(self.places) >= MAX_NODES:
            raise self._error(node, f"the document has more than {MAX_NODES} values")
        if len(path) > MAX_DEPTH:
            raise self._error(node, f"the document is nested deeper than {MAX_DEPTH}")
        if node.tag not in TAGS:
            raise self._error(node, f"the tag {node.tag} has no place here")

    def _error(self, node: yaml.Node, message: str) -> DocumentError:
        return DocumentError(
            [Problem(message, node.start_mark.line + 1, node.start_mark.column + 1)], self._file
        )
