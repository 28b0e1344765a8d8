"""The library of behaviours: subtrees with ports, each with the trees and actions that it needs.

The files are in `behaviours/`: `library.json` lists the behaviours; `trees/` and `actions/` hold the files
that are inserted. The files that a behaviour needs are found from its tree, so none can be forgotten.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

LIBRARY: Final = Path(__file__).parent / "behaviours"
SUBTREE: Final = "SubTree"


@dataclass(frozen=True, slots=True)
class Behaviour:
    """A behaviour of the library; `summary` and `doc` hold a text for each language."""

    id: str
    version: str
    group: str
    universe: str
    summary: dict[str, str]
    doc: dict[str, str]
    diagram: dict[str, Any]
    files: dict[str, str]


@lru_cache(maxsize=1)
def behaviours() -> tuple[Behaviour, ...]:
    """Returns all behaviours, in the order of the table."""
    table = json.loads((LIBRARY / "library.json").read_bytes())
    return tuple(
        Behaviour(**row, diagram=_diagram(row["id"]), files=files_of(row["id"]))
        for row in table["behaviours"]
    )


def files_of(behaviour_id: str) -> dict[str, str]:
    """Returns the files that a behaviour needs, by path: its tree, subtrees and actions."""
    files: dict[str, str] = {}
    waiting = [behaviour_id]
    while waiting:
        tree_id = waiting.pop()
        path = f"trees/{tree_id}.json"
        if path in files:
            continue
        files[path] = (LIBRARY / path).read_text(encoding="utf-8")
        for node in _diagram(tree_id)["nodes"].values():
            action = f"actions/{node['type']}.py"
            if node["type"] == SUBTREE:
                waiting.append(node["tree"])
            elif (LIBRARY / action).is_file():
                files[action] = (LIBRARY / action).read_text(encoding="utf-8")
    return dict(sorted(files.items()))


def _diagram(tree_id: str) -> dict[str, Any]:
    diagram: dict[str, Any] = json.loads((LIBRARY / "trees" / f"{tree_id}.json").read_bytes())
    return diagram
