"""Reads a diagram of JdeRobot's BT Studio, a serialisation of react-diagrams.

Real files have links in both directions: only the types of its two ports give a link its meaning. The order
of children is that of their height on the canvas.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.diagram import FORMAT, restore_document
from translator.json_file import parse_json
from translator.migrate import PLAIN_VERSION
from translator.text import clean
from translator.tree import SUBTREE

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator, Mapping

    from translator.tree import Tree

ROOT_NAME = "Tree Root"
PORT_TYPES = {"parent port": "parent", "children port": "children"}
PORT_NAMES = {("Delay", "delay_ms"): "delay_msec"}


@dataclass(slots=True)
class _Block:
    """A block of the graph: a node, or a tag that holds a value."""

    id: str
    is_tag: bool
    name: str
    y: float
    is_subtree: bool
    children: list[str] = field(default_factory=list)
    ports: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class _Port:
    block: str
    type: str
    name: str


@dataclass(frozen=True, slots=True)
class GraphOptions:
    """The settings of a tree that its graph does not contain."""

    tree_id: str
    file: str
    bottom_to_top: bool
    subtrees: Mapping[str, str]  # name on the canvas -> id of the tree


def read_graph(raw: bytes, options: GraphOptions) -> tuple[Tree | None, tuple[Diagnostic, ...]]:
    """Reads a graph; returns the tree, or None if nothing can be read, and the findings."""
    document, problem = parse_json(raw, file=options.file)
    if problem is not None:
        return None, (problem,)
    reader = _Reader(options)
    return reader.tree(document), tuple(reader.found)


class _Reader:
    """Converts one graph to a diagram of BT Studio."""

    def __init__(self, options: GraphOptions) -> None:
        self.options = options
        self.found: list[Diagnostic] = []
        self.blocks: dict[str, _Block] = {}
        self.ports: dict[str, _Port] = {}
        self.parents: dict[str, str] = {}

    def report(self, code: str, node: str = "", **values: object) -> None:
        place = Place(self.options.file, tree=self.options.tree_id, node=node)
        self.found.append(diagnostic(code, place, **values))

    def tree(self, document: Any) -> Tree | None:
        models = list(_models(document))
        if not models:
            self.report("BT0801")
            return None
        for model in models:
            if "source" not in model and "sourcePort" not in model:
                self.read_block(model)
        for model in models:
            if "source" in model or "sourcePort" in model:
                self.read_link(model)
        self.sort_children()
        tree, repaired = restore_document(self.diagram(), file=self.options.file)
        self.found.extend(repaired)
        return tree

    def read_block(self, model: dict[str, Any]) -> None:
        block_id, name = model.get("id"), model.get("name")
        if not isinstance(block_id, str) or not isinstance(name, str):
            self.report("BT0802")
            return
        y = model.get("y")
        is_tag = model.get("type") == "tag"
        self.blocks[block_id] = _Block(
            block_id, is_tag, clean(name), _number(y), model.get("is_subtree") is True
        )
        ports = model.get("ports")
        for port in ports if isinstance(ports, list) else ():
            if isinstance(port, dict) and isinstance(port.get("id"), str):
                type_ = str(port.get("type", ""))
                label = clean(str(port.get("name", "")))
                self.ports[port["id"]] = _Port(block_id, PORT_TYPES.get(type_, type_), label)

    def read_link(self, model: dict[str, Any]) -> None:
        ends = [self.end(model, "source"), self.end(model, "target")]
        known = [end for end in ends if end is not None]
        if len(known) < 2:
            self.report("BT0804", known[0].block if known else "")
            return
        by_type = {end.type: end for end in known}
        join = _JOINS.get(frozenset(by_type))
        if join is None:
            types = " and ".join(end.type for end in known)
            self.report("BT0803", known[0].block, types=types)
            return
        join(self, by_type)

    def end(self, model: dict[str, Any], side: str) -> _Port | None:
        port = self.ports.get(str(model.get(f"{side}Port")))
        return port if port is not None and port.block in self.blocks else None

    def join_child(self, ends: dict[str, _Port]) -> None:
        parent, child = ends["children"].block, ends["parent"].block
        if child in self.parents:
            if self.parents[child] != parent:
                self.report("BT0022", parent, child=self.blocks[child].name)
            return
        self.parents[child] = parent
        self.blocks[parent].children.append(child)

    def join_input(self, ends: dict[str, _Port]) -> None:
        self.set_port(ends["input"], ends["tag output"])

    def join_output(self, ends: dict[str, _Port]) -> None:
        self.set_port(ends["output"], ends["tag input"])

    def set_port(self, port: _Port, tag: _Port) -> None:
        block = self.blocks[port.block]
        name = PORT_NAMES.get((block.name, port.name), port.name)
        value = self.blocks[tag.block].name
        if name in block.ports and block.ports[name] != value:
            self.report("BT0805", block.id, port=name, value=block.ports[name], other=value)
            return
        block.ports[name] = value

    def sort_children(self) -> None:
        sign = -1 if self.options.bottom_to_top else 1
        for block in self.blocks.values():
            block.children.sort(key=lambda child: sign * self.blocks[child].y)

    def diagram(self) -> dict[str, Any]:
        roots = [block for block in self.blocks.values() if block.name == ROOT_NAME and not block.is_tag]
        tops = [child for root in roots for child in root.children]
        if not roots:
            loose = [block for block in self.nodes() if block.id not in self.parents]
            tops = [max(loose, key=lambda block: len(block.children)).id] if loose else []
            self.report("BT0806", tops[0] if tops else "")
        elif len(tops) > 1:
            self.report("BT0807", tops[1])
        nodes = {block.id: self.row(block) for block in self.nodes()}
        return {
            "format": FORMAT,
            "version": PLAIN_VERSION,
            "id": self.options.tree_id,
            "root": tops[0] if tops else None,
            "nodes": nodes,
            "drafts": tops[1:],
            "layout": "vertical",
        }

    def nodes(self) -> Iterator[_Block]:
        return (block for block in self.blocks.values() if not block.is_tag and block.name != ROOT_NAME)

    def row(self, block: _Block) -> dict[str, Any]:
        children = [child for child in block.children if self.blocks[child].name != ROOT_NAME]
        row: dict[str, Any] = {"type": block.name, "ports": block.ports, "children": children}
        if block.is_subtree or block.name in self.options.subtrees:
            # In JdeRobot's BT Studio, all trees share one blackboard.
            row["type"] = SUBTREE
            row["tree"] = self.options.subtrees.get(block.name, block.name)
            row["attributes"] = {"_autoremap": "true"}
        return row


_JOINS: dict[frozenset[str], Callable[[_Reader, dict[str, _Port]], None]] = {
    frozenset({"parent", "children"}): _Reader.join_child,
    frozenset({"input", "tag output"}): _Reader.join_input,
    frozenset({"output", "tag input"}): _Reader.join_output,
}


def _models(document: Any) -> Iterator[dict[str, Any]]:
    """Yields the blocks and links of all layers; a layer's models are a dict by id, or a list."""
    layers = document.get("layers") if isinstance(document, dict) else None
    for layer in layers if isinstance(layers, list) else ():
        models = layer.get("models") if isinstance(layer, dict) else None
        items: Collection[Any] = models.values() if isinstance(models, dict) else models or ()
        for model in items if not isinstance(items, str | int | float) else ():
            if isinstance(model, dict):
                yield model


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return 0.0
    return float(value) if abs(value) < 1e12 and math.isfinite(value) else 0.0


def looks_like_graph(raw: bytes) -> bool:
    """Returns whether a JSON file is a serialisation of react-diagrams, from its beginning."""
    return b'"layers"' in raw[:100_000]
