"""A project that is as large as its quota lets it be."""

from __future__ import annotations

import json

WIDTH = 100


def large_tree(nodes: int, name: str = "MainTree") -> str:
    """A diagram of a tree with so many nodes, none deeper than the third level."""
    found = {"r": {"type": "Sequence", "name": "", "children": []}}
    while len(found) < nodes:
        group = f"s{len(found)}"
        found["r"]["children"].append(group)
        found[group] = {"type": "Fallback", "name": "", "children": []}
        for number in range(min(WIDTH, nodes - len(found))):
            leaf = f"{group}_{number}"
            found[group]["children"].append(leaf)
            found[leaf] = {"type": "AlwaysSuccess", "name": f"leaf {number}"}
    diagram = {
        "format": "bt-studio/diagram",
        "version": 1,
        "id": name,
        "root": "r",
        "nodes": found,
        "drafts": [],
    }
    return json.dumps(diagram)
