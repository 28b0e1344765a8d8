"""Writes `repairs.json`: broken diagrams, each as the translator repairs it; the editor must do the same.

python -m tests.shared.make_repairs
"""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any, Final

from translator.diagram import restore_document

HERE: Final = Path(__file__).parent
FILE: Final = HERE / "repairs.json"
NAMES: Final = "rabcde"
RANDOM: Final = 120
WRITTEN: Final[tuple[tuple[str, list[str], dict[str, list[str]]], ...]] = (
    ("r", [], {"r": [], "a": ["b"], "b": ["a"]}),
    ("r", ["b"], {"r": [], "a": ["b"], "b": ["a"]}),
    ("r", [], {"r": [], "b": ["c"], "a": ["b"], "c": ["a"]}),
    ("r", [], {"r": ["a"], "a": ["b"], "b": ["r"]}),
    ("r", [], {"r": [], "a": ["b", "c"], "b": ["a"], "c": ["d"], "d": []}),
    ("r", [], {"r": [], "a": ["b"], "b": ["b", "a"], "c": ["a"]}),
    ("gone", ["a", "a", "gone"], {"a": ["b"], "b": []}),
    ("r", ["b"], {"a": ["b"], "b": [], "r": ["b"]}),
)


def cases() -> list[dict[str, Any]]:
    """All cases: those above, and random ones."""
    chosen = random.Random(5)  # noqa: S311 - no secret
    given = [{"root": root, "drafts": drafts, "nodes": nodes} for root, drafts, nodes in WRITTEN]
    for _ in range(RANDOM):
        order = chosen.sample(NAMES, len(NAMES))
        nodes = {name: chosen.choices(NAMES, k=chosen.choice((0, 1, 1, 2))) for name in order}
        given.append({"root": "r", "drafts": chosen.choices(NAMES, k=chosen.randrange(3)), "nodes": nodes})
    return [repaired(each) for each in given]


def repaired(given: dict[str, Any]) -> dict[str, Any]:
    """Returns a case with the root, the drafts and the children after the repair."""
    nodes = {name: {"type": "Sequence", "children": below} for name, below in given["nodes"].items()}
    document = {"format": "bt-studio/diagram", "version": 1, "id": "T", **given, "nodes": nodes}
    tree, _ = restore_document(document, file="trees/T.json")
    assert tree is not None
    children = {name: list(node.children) for name, node in tree.nodes.items()}
    return {"given": given, "root": tree.root, "drafts": list(tree.drafts), "children": children}


def text() -> str:
    """The content of the file."""
    lines = ",\n".join(json.dumps(case) for case in cases())
    return f"[\n{lines}\n]\n"


def main() -> None:
    """Writes the file."""
    FILE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
