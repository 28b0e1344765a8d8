"""Writes `differences.json`: pairs of diagrams and the operations between them, for both languages.

python -m tests.shared.make_differences
"""

from __future__ import annotations

import json
import random
from copy import deepcopy
from pathlib import Path
from typing import Any, Final

from translator.difference import compare

FILE: Final = Path(__file__).with_name("differences.json")
SEEDS: Final = 60
TYPES: Final = ("Sequence", "Fallback", "Inverter", "Forward", "Turn", "AlwaysSuccess")

Nodes = dict[str, dict[str, Any]]


def diagram(
    nodes: Nodes, root: str | None = "r", drafts: tuple[str, ...] = (), **more: Any
) -> dict[str, Any]:
    """A diagram of these nodes."""
    return {
        "format": "bt-studio/diagram", "version": 1, "id": "MainTree", "root": root,
        "nodes": nodes, "drafts": list(drafts), "layout": "vertical", **more,
    }  # fmt: skip


OLDER: Final = diagram(
    {
        "r": {"type": "Sequence", "children": ["a", "b", "c", "s"]},
        "a": {"type": "Forward", "ports": {"speed": "0.2", "gone": "x"}, "position": [1, 2]},
        "b": {"type": "Inverter", "children": ["d"]},
        "c": {"type": "Turn", "name": "left"},
        "d": {"type": "IsNear", "ports": {"distance": "{d}"}},
        "s": {"type": "Fallback", "name": "rescue", "children": ["e", "f"]},
        "e": {"type": "Forward", "ports": {"speed": "-0.1"}},
        "f": {"type": "SubTree", "tree": "Help"},
        "z": {"type": "AlwaysFailure"},
    },
    drafts=("z",),
)


def changed(**rows: dict[str, Any] | None) -> dict[str, Any]:
    """The older diagram with some rows replaced, added, or (None) taken away."""
    newer = deepcopy(OLDER)
    for node_id, row in rows.items():
        if row is None:
            del newer["nodes"][node_id]
        else:
            newer["nodes"][node_id] = {**newer["nodes"].get(node_id, {}), **row}
    return newer


def under_new_ids(document: dict[str, Any], prefix: str) -> dict[str, Any]:
    """A diagram with other ids for its nodes, as after a paste."""
    nodes = {
        prefix + node_id: {**row, "children": [prefix + child for child in row.get("children", [])]}
        for node_id, row in document["nodes"].items()
    }
    root = None if document["root"] is None else prefix + document["root"]
    return {
        **document,
        "nodes": nodes,
        "root": root,
        "drafts": [prefix + each for each in document["drafts"]],
    }


def written() -> dict[str, tuple[dict[str, Any], dict[str, Any]]]:
    """Cases with a name of their own."""
    wrapped = changed(r={"children": ["a", "w", "s"]}, w={"type": "Sequence", "children": ["b", "c"]})
    twice = changed(
        r={"children": ["a", "b", "w", "s"]},
        w={"type": "Repeat", "ports": {"num_cycles": "3"}, "children": ["v"]},
        v={"type": "Inverter", "children": ["c"]},
    )
    top = changed(t={"type": "KeepRunningUntilFailure", "children": ["r"]})
    top["root"] = "t"
    loose = changed(r={"children": ["a", "b", "s"]})
    loose["drafts"] = ["z", "c"]
    empty = diagram({}, root=None)
    ports = [
        {"name": "speed", "direction": "input", "type": "double"},
        {"name": "done", "direction": "output"},
    ]
    return {
        "equal": (OLDER, changed()),
        "layout alone": (
            OLDER,
            {**changed(a={"position": [7, 8]}, s={"collapsed": True}), "layout": "horizontal"},
        ),
        "ports": (OLDER, changed(a={"ports": {"speed": "0.3", "new": "{k}"}})),
        "renamed": (OLDER, changed(c={"name": "right"}, a={"name": ""})),
        "conditions, comment, flag": (
            OLDER,
            changed(
                d={"conditions": {"_skipIf": "x > 1"}, "comment": "why", "disabled": True, "color": "#9c27b0"}
            ),
        ),
        "type and target": (OLDER, changed(b={"type": "ForceSuccess"}, f={"tree": "Rescue"})),
        "attributes and unknown keys": (
            OLDER,
            changed(f={"attributes": {"_autoremap": "true"}, "later": {"b": 1, "a": [2]}}),
        ),
        "inserted": (OLDER, changed(r={"children": ["a", "n", "b", "c", "s"]}, n={"type": "AlwaysSuccess"})),
        "deleted branch": (OLDER, changed(r={"children": ["a", "b", "c"]}, s=None, e=None, f=None)),
        "moved": (OLDER, changed(r={"children": ["a", "b", "s"]}, s={"children": ["e", "c", "f"]})),
        "reordered": (OLDER, changed(r={"children": ["c", "a", "b", "s"]})),
        "turned round": (OLDER, changed(r={"children": ["s", "c", "b", "a"]})),
        "wrapped": (OLDER, wrapped),
        "wrapped twice": (OLDER, twice),
        "unwrapped": (OLDER, changed(r={"children": ["a", "d", "c", "s"]}, b=None)),
        "another decorator": (
            OLDER,
            changed(r={"children": ["a", "w", "c", "s"]}, b=None, w={"type": "Repeat", "children": ["d"]}),
        ),
        "a new root": (OLDER, top),
        "made a draft": (OLDER, loose),
        "child and parent exchanged": (
            changed(b={"children": ["s"]}, r={"children": ["a", "b", "c"]}, d=None),
            changed(
                s={"children": ["b"]}, b={"children": ["e", "f"]}, r={"children": ["a", "s", "c"]}, d=None
            ),
        ),
        "ports of the tree": (
            {**OLDER, "ports": ports[:1]},
            {**OLDER, "id": "Other", "ports": [{**ports[0], "type": "int"}, ports[1]]},
        ),
        "made": (empty, OLDER),
        "emptied": (OLDER, empty),
        "other ids": (OLDER, under_new_ids(OLDER, "x")),
        "other ids, a port changed": (OLDER, under_new_ids(changed(a={"ports": {"speed": "0.9"}}), "x")),
        "other ids, wrapped": (OLDER, under_new_ids(wrapped, "x")),
        "other ids, moved": (
            OLDER,
            under_new_ids(changed(r={"children": ["a", "c", "s"]}, s={"children": ["b", "e", "f"]}), "x"),
        ),
        "cut and pasted": (
            OLDER,
            changed(
                r={"children": ["n", "a", "b", "c"]},
                s=None,
                e=None,
                f=None,
                n={"type": "Fallback", "name": "rescue", "children": ["m", "o"]},
                m={"type": "Forward", "ports": {"speed": "-0.1"}},
                o={"type": "SubTree", "tree": "Help"},
            ),
        ),
        "many alike": (
            diagram(
                {
                    "r": {"type": "Sequence", "children": ["a", "b", "c"]},
                    **{key: {"type": "Forward"} for key in "abc"},
                }
            ),
            diagram(
                {
                    "q": {"type": "Sequence", "children": ["x", "y"]},
                    **{key: {"type": "Forward"} for key in "xy"},
                },
                root="q",
            ),
        ),
    }


def lucky(seed: int) -> random.Random:
    """The same luck each time."""
    return random.Random(seed)  # noqa: S311 - nothing is secret here


def grown(luck: random.Random, size: int) -> dict[str, Any]:
    """A random diagram."""
    nodes: Nodes = {"r": {"type": "Sequence", "children": []}}
    for number in range(size):
        hosts = [key for key, row in nodes.items() if "children" in row]
        type_ = luck.choice(TYPES)
        row: dict[str, Any] = {"type": type_}
        if luck.random() < 0.5:
            row["ports"] = {"speed": str(luck.randrange(4))}
        if type_ in {"Sequence", "Fallback"}:
            row["children"] = []
        nodes[f"n{number}"] = row
        siblings = nodes[luck.choice(hosts)]["children"]
        siblings.insert(luck.randrange(len(siblings) + 1), f"n{number}")
    return diagram(nodes)


def edited(luck: random.Random, document: dict[str, Any], steps: int, mark: str = "m") -> dict[str, Any]:
    """A diagram after random edits; new nodes have ids that begin with `mark`."""
    newer = deepcopy(document)
    nodes: Nodes = newer["nodes"]
    for step in range(steps):
        node_id = luck.choice(sorted(set(nodes) - {newer["root"]}) or ["r"])
        parent = next((row for row in nodes.values() if node_id in row.get("children", ())), None)
        what = luck.randrange(6)
        if what == 0 or parent is None:
            nodes[node_id]["ports"] = {"speed": str(luck.randrange(9))}
        elif what == 1:
            nodes[node_id]["name"] = f"name {luck.randrange(9)}"
        elif what == 2:
            wrapper = f"{mark}{step}"
            nodes[wrapper] = {"type": "Sequence", "children": [node_id]}
            parent["children"][parent["children"].index(node_id)] = wrapper
        elif what == 3:
            at = parent["children"].index(node_id)
            parent["children"][at : at + 1] = nodes.pop(node_id).get("children", [])
        elif what == 4:
            nodes[f"{mark}{step}"] = {"type": luck.choice(TYPES[3:]), "ports": {"speed": str(step)}}
            parent["children"].insert(luck.randrange(len(parent["children"]) + 1), f"{mark}{step}")
        else:
            below = branch(nodes, node_id)
            hosts = [key for key, row in sorted(nodes.items()) if "children" in row and key not in below]
            parent["children"].remove(node_id)
            siblings = nodes[luck.choice(hosts)]["children"]
            siblings.insert(luck.randrange(len(siblings) + 1), node_id)
    return newer


def branch(nodes: Nodes, top: str) -> set[str]:
    """A node and all below it."""
    return {top}.union(*(branch(nodes, child) for child in nodes[top].get("children", ())))


def cases() -> dict[str, tuple[dict[str, Any], dict[str, Any]]]:
    """All cases, the random ones from their seeds."""
    found = written()
    for seed in range(SEEDS):
        luck = lucky(seed)
        older = grown(luck, luck.randrange(2, 14))
        newer = edited(luck, older, luck.randrange(1, 6))
        found[f"seed {seed}"] = older, under_new_ids(newer, "x") if seed % 2 else newer
    return found


def text() -> str:
    """The file: one line a case."""
    rows = [
        {"what": what, "older": older, "newer": newer, "operations": compare(older, newer),
         "layout": compare(older, newer, layout=True)}
        for what, (older, newer) in cases().items()
    ]  # fmt: skip
    return "[\n" + ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows) + "\n]\n"


def main() -> None:
    """Writes the file."""
    FILE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
