"""Writes graphs as JdeRobot's BT Studio saves them: a react-diagrams serialisation, with all its oddities."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

ROOT = "Tree Root"


@dataclass
class Graph:
    """Blocks and links, added one by one; ids are readable so that tests can refer to them."""

    old_port_types: bool = False
    blocks: dict[str, dict[str, Any]] = field(default_factory=dict)
    links: dict[str, dict[str, Any]] = field(default_factory=dict)

    def node(
        self, id_: str, name: str, y: float = 0, *, ports: dict[str, str] | None = None, **more: Any
    ) -> str:
        """Adds a basic block; `ports` are its own, by name, with `input` or `output`."""
        parent, children = ("parent port", "children port") if self.old_port_types else ("parent", "children")
        rows = [self._port(id_, children, "children")]
        if name != ROOT:
            rows.append(self._port(id_, parent, "parent"))
        rows += [self._port(id_, direction, port) for port, direction in (ports or {}).items()]
        block = {"id": id_, "type": "basic", "x": 0, "y": y, "name": name, "color": "rgb(0,204,0)"}
        self.blocks[id_] = {**block, "ports": rows, **more}
        return id_

    def tag(self, id_: str, value: str, *, writes: bool = False) -> str:
        """Adds a value; one that `writes` receives the value of an output port."""
        kind = "tag input" if writes else "tag output"
        rows = [self._port(id_, kind, kind)]
        color = "var(--color-tag)"
        self.blocks[id_] = {
            "id": id_,
            "type": "tag",
            "x": 0,
            "y": 0,
            "name": value,
            "color": color,
            "ports": rows,
        }
        return id_

    def join(self, parent: str, child: str, *, backwards: bool = False) -> None:
        """Links a parent and a child; real files hold links in both directions."""
        ends = (f"{parent}.children", f"{child}.parent")
        self.link(*(reversed(ends) if backwards else ends))

    def feed(self, tag: str, node: str, port: str, *, backwards: bool = False) -> None:
        """Links a value and a port of a node."""
        ends = (f"{tag}.{self.blocks[tag]['ports'][0]['name']}", f"{node}.{port}")
        self.link(*(reversed(ends) if backwards else ends))

    def link(self, source: str, target: str | None) -> None:
        """Adds a link between two ports, each `block.port`."""
        id_ = f"link{len(self.links)}"
        self.links[id_] = {
            "id": id_,
            "type": "default",
            "source": source.split(".", maxsplit=1)[0],
            "sourcePort": source,
            "target": target.split(".")[0] if target else None,
            "targetPort": target,
            "points": [],
        }

    def document(self) -> dict[str, Any]:
        """Returns the serialisation."""
        return {
            "id": "graph",
            "offsetX": 0,
            "offsetY": 0,
            "zoom": 100,
            "gridSize": 0,
            "layers": [
                {"id": "l1", "type": "diagram-links", "isSvg": True, "models": self.links},
                {"id": "l2", "type": "diagram-nodes", "isSvg": False, "models": self.blocks},
            ],
        }

    def to_bytes(self) -> bytes:
        """Returns the file."""
        return json.dumps(self.document(), indent=4).encode()

    @staticmethod
    def _port(block: str, type_: str, name: str) -> dict[str, Any]:
        row = {"id": f"{block}.{name}", "type": type_, "name": name, "parentNode": block, "links": []}
        return {**row, "in": type_ in {"parent", "parent port", "input", "tag input"}}


def chain(*names: str) -> Graph:
    """Returns a graph in which each block has the next as its only child, starting at the root."""
    graph = Graph()
    before = graph.node("root", ROOT)
    for number, name in enumerate(names):
        current = graph.node(f"b{number}", name)
        graph.join(before, current)
        before = current
    return graph
