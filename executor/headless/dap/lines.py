"""The lines of blocks in the files of a tree: diagrams (JSON) and trees of BehaviorTree.CPP (XML). Pure."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.debugging import Place, place_of
from tree_gardener.document import parse_document
from tree_gardener.errors import LoadError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from tree_gardener.document import Element
    from tree_gardener.node import Node

__all__ = ["Block", "Lines", "NoBlockError"]

ENDINGS: Final = (".json", ".xml", ".btproj")
_TOKEN: Final = re.compile(r'"(?:[^"\\]|\\.)*"|[{}\[\]\n]')
_START: Final = re.compile(rb"""<(?:[^<>"']|"[^"]*"|'[^']*')*>""")
_OTHER: Final = "its blocks are not those of the tree that runs"
_NO_TREE: Final = "the file is no tree of this project"
_PYTHON: Final = "; breakpoints in Python are set in the page: open the file there, and press beside a line"
_BELOW: Final = "there is no block in this line or below it"


class NoBlockError(ValueError):
    """A line means no block; the text says why."""


@dataclass(frozen=True)
class Block:
    """A block in a file.

    Attributes:
        place: the block, in all instances of its tree.
        first, last: its first and last line, from 1, without those of the blocks below it.
    """

    place: Place
    first: int
    last: int


class Lines:
    """The blocks of a project, by file and line.

    Args:
        files: the texts of the files, by path.
        nodes: the nodes of the tree that runs, in pre-order.
    """

    def __init__(self, files: Mapping[str, bytes], nodes: Sequence[Node]) -> None:
        self._blocks: dict[str, list[Block]] = {}
        self._why: dict[str, str] = {}
        self._at: dict[Place, tuple[str, int]] = {}
        trees = _trees_of(nodes)
        for path, data in files.items():
            if PurePosixPath(path).suffix.lower() in ENDINGS:
                self._add(path, data, trees)

    def block(self, path: str, line: int) -> Block:
        """Returns the block in a line, or the next one below it.

        Raises:
            NoBlockError: there is none.
        """
        blocks = self._blocks.get(path, ())
        if path in self._why or path not in self._blocks:
            is_python = PurePosixPath(path).suffix.lower() == ".py"
            raise NoBlockError(self._why.get(path, f"{_NO_TREE}{_PYTHON if is_python else ''}"))
        around = [each for each in blocks if each.first <= line <= each.last]
        if around:
            return max(around, key=lambda each: each.first)
        below = [each for each in blocks if each.first > line]
        if not below:
            raise NoBlockError(_BELOW)
        return min(below, key=lambda each: each.first)

    def line(self, node: Node) -> tuple[str, int] | None:
        """Returns the file and the line of a node; None if no file has it."""
        return self._at.get(place_of(node))

    def _add(self, path: str, data: bytes, trees: Mapping[str, list[Node]]) -> None:
        try:
            read = _of_diagram if path.lower().endswith(".json") else _of_xml
            found = list(read(path, data, trees))
        except NoBlockError as error:
            self._why[path] = str(error)
            return
        except (LoadError, ValueError, RecursionError):
            self._why[path] = "the file is no tree that can be read"
            return
        self._blocks[path] = found
        for block in found:
            self._at.setdefault(block.place, (path, block.first))


def _trees_of(nodes: Sequence[Node]) -> dict[str, list[Node]]:
    """Returns the nodes of one instance of each tree, in pre-order."""
    trees: dict[str, list[Node]] = {}
    first: dict[str, Any] = {}
    for node in nodes:
        if first.setdefault(node.tree_id, node.instance) is node.instance:
            trees.setdefault(node.tree_id, []).append(node)
    return trees


def _of_diagram(_path: str, data: bytes, trees: Mapping[str, list[Node]]) -> Iterator[Block]:
    text = data.decode("utf-8")
    document = json.loads(text)
    if not isinstance(document, dict) or document.get("format") != "bt-studio/diagram":
        raise NoBlockError("the file is no diagram")
    tree_id = str(document.get("id"))
    known = {node.node_id for node in trees.get(tree_id, ())}
    spans = {key: span for key, span in _spans(text) if key in known}
    if tree_id not in trees:
        raise NoBlockError(f"the tree {tree_id} is not part of the one that runs")
    below = document.get("nodes")
    for key, (first, last) in spans.items():
        if isinstance(below, dict) and key in below:
            yield Block(Place(tree_id, key), first, last)


def _spans(text: str) -> Iterator[tuple[str, tuple[int, int]]]:
    """Yields the key and the lines of each object of `nodes` in a diagram."""
    line, depth, last_text, in_nodes = 1, 0, "", False
    key, first = "", 0
    for token in _TOKEN.finditer(text):
        sign = token[0]
        if sign == "\n":
            line += 1
        elif sign[0] == '"':
            last_text = json.loads(sign)
            if depth == 2 and in_nodes:
                first = line
        elif sign in "{[":
            depth += 1
            if depth == 2:
                in_nodes = last_text == "nodes" and sign == "{"
            elif depth == 3 and in_nodes:
                key = last_text
        else:
            if depth == 3 and in_nodes:
                yield key, (first, line)
            depth -= 1
            in_nodes = in_nodes and depth >= 2


def _of_xml(path: str, data: bytes, trees: Mapping[str, list[Node]]) -> Iterator[Block]:
    document = parse_document(data, path)
    known = [each for each in document.root.children if each.tag == "BehaviorTree"]
    main = document.root.attributes.get("main_tree_to_execute", "")
    blocks: list[Block] = []
    has_other = False
    for tree in known:
        nodes = trees.get(tree.attributes.get("ID", main))
        elements = [each for each in tree.walk() if each is not tree]
        if nodes is None:
            continue
        if [_type_of(each) for each in elements] != [node.type for node in nodes]:
            has_other = True
            continue
        for element, node in zip(elements, nodes, strict=True):
            first = document.locate(element.offset)[0]
            tag = _START.match(data, element.offset)
            more = tag[0].count(b"\n") if tag is not None else 0
            blocks.append(Block(place_of(node), first, first + more))
    if not blocks:
        raise NoBlockError(_OTHER if has_other else "the file has no tree that runs")
    yield from blocks


def _type_of(element: Element) -> str:
    if element.tag in {"Action", "Condition", "Control", "Decorator"}:
        return element.attributes.get("ID", "")
    return element.tag
