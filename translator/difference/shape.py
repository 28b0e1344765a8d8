"""A diagram document as the comparison sees it: rows, parents, order of execution.

The document is the JSON of `docs/reference/schemas/diagram.schema.json`; the page has the same one
(`frontend/src/model/difference/shape.ts`). So unknown keys of newer versions are compared, too.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

Document = Mapping[str, Any]
Row = Mapping[str, Any]
Parent = str | None

ROOT = ""
"""The parent of the root. Drafts have no parent: None."""

TEXTS = ("type", "tree", "comment", "color", "disabled")
MAPS = ("ports", "conditions", "attributes", "silenced")
LAYOUT = ("position", "collapsed")
KNOWN = frozenset({*TEXTS, *MAPS, *LAYOUT, "name", "children"})


@dataclass(frozen=True)
class Shape:
    """A document with its links in both directions."""

    document: Document

    @cached_property
    def rows(self) -> Mapping[str, Row]:
        """The nodes by id."""
        rows: Mapping[str, Row] = self.document["nodes"]
        return rows

    @cached_property
    def parents(self) -> Mapping[str, Parent]:
        """The parent of each node."""
        parents: dict[str, Parent] = dict.fromkeys(self.rows)
        if (root := self.document.get("root")) is not None:
            parents[root] = ROOT
        for node_id, row in self.rows.items():
            parents.update(dict.fromkeys(row.get("children", ()), node_id))
        return parents

    @cached_property
    def order(self) -> tuple[str, ...]:
        """All nodes: the tree in its order of execution, then the drafts."""
        found: list[str] = []
        stack = list(reversed([*self.children(ROOT), *self.children(None)]))
        while stack:
            node_id = stack.pop()
            found.append(node_id)
            stack.extend(reversed(self.children(node_id)))
        return tuple(found)

    @cached_property
    def ranks(self) -> Mapping[str, int]:
        """The place of each node in `order`."""
        return {node_id: rank for rank, node_id in enumerate(self.order)}

    @cached_property
    def sizes(self) -> Mapping[str, int]:
        """The number of nodes of each branch."""
        sizes: dict[str, int] = {}
        for node_id in reversed(self.order):
            sizes[node_id] = 1 + sum(sizes[child] for child in self.children(node_id))
        return sizes

    def children(self, parent: Parent) -> tuple[str, ...]:
        """The children of a node, the root, or the drafts."""
        if parent is None:
            return tuple(self.document.get("drafts", ()))
        if parent == ROOT:
            root = self.document.get("root")
            return () if root is None else (root,)
        return tuple(self.rows[parent].get("children", ()))

    def branch(self, node_id: str) -> tuple[str, ...]:
        """A node and all nodes below it, in order of execution."""
        start = self.ranks[node_id]
        return self.order[start : start + self.sizes[node_id]]

    def index(self, node_id: str) -> int:
        """The place of a node among its siblings."""
        return self.children(self.parents[node_id]).index(node_id)


def text(value: Any) -> str:
    """Returns a value as it is shown and compared."""
    if isinstance(value, str):
        return value
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"), sort_keys=True)


def fields(row: Row, *, layout: bool = False) -> dict[str, str]:
    """Returns the fields of a node that differ from their defaults, by name (a port is `ports.<name>`)."""
    found: dict[str, str] = {}
    for key in TEXTS:
        if row.get(key):
            found[key] = text(row[key])
    if row.get("name") is not None:
        found["name"] = row["name"]
    for part in MAPS:
        values = row.get(part) or {}
        found.update((f"{part}.{key}", text(values[key])) for key in sorted(values))
    found.update((key, text(row[key])) for key in sorted(row.keys() - KNOWN))
    if layout:
        found.update((key, text(row[key])) for key in LAYOUT if row.get(key))
    return found


def tree_fields(document: Document, *, layout: bool = False) -> dict[str, str]:
    """Returns the fields of a document, except its nodes, by name."""
    found = {"id": text(document.get("id", ""))}
    for port in document.get("ports") or ():
        rest = {key: value for key, value in port.items() if key != "name"}
        found[f"ports.{port['name']}"] = text(rest)
    values = document.get("attributes") or {}
    found.update((f"attributes.{key}", text(values[key])) for key in sorted(values))
    if layout and document.get("layout", "vertical") != "vertical":
        found["layout"] = text(document["layout"])
    return found
