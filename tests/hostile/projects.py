"""A project as large as its quota allows."""

from __future__ import annotations

import json
from typing import Any

WIDTH = 100
NODES_PER_TREE = 20_000


def large_tree(nodes: int, name: str) -> str:
    """Returns a diagram of a tree with that many nodes, none deeper than the third level."""
    top: dict[str, Any] = {"type": "Sequence", "name": "", "children": []}
    found = {"r": top}
    while len(found) < nodes - 1:
        group = f"s{len(found)}"
        found[group] = {"type": "Fallback", "name": "", "children": []}
        top["children"].append(group)
        for number in range(min(WIDTH, nodes - len(found))):
            leaf = f"{group}_{number}"
            found[group]["children"].append(leaf)
            found[leaf] = {"type": "AlwaysSuccess", "name": f"leaf {number}"}
    diagram = {"format": "bt-studio/diagram", "version": 1, "id": name, "root": "r", "nodes": found}
    return json.dumps(diagram | {"drafts": [], "layout": "vertical"})


def large_files(nodes: int, files: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Returns files that add up to that many nodes, in trees of 20,000; `files` are the existing ones."""
    bases = {file["path"]: file["revision"] for file in files}
    first = next(path for path in bases if path.startswith("trees/")).split("/")[1].removesuffix(".json")
    changes = []
    for number in range(0, nodes, NODES_PER_TREE):
        name = f"Large{number}" if number else first
        path = f"trees/{name}.json"
        tree = large_tree(min(NODES_PER_TREE, nodes - number), name)
        changes.append({"path": path, "content": tree, "base_revision": bases.get(path, 0)})
    return changes
