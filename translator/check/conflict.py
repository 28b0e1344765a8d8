"""Refuses trees in which a merge has left a decision."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from translator.difference.words import shown
from translator.tree import CONFLICTS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from translator.check.context import Context
    from translator.tree import Tree

LONGEST = 60


def check_conflicts(context: Context) -> None:
    """Reports each conflict at its node."""
    for tree in context.project.trees.values():
        for conflict in conflicts_of(tree):
            node = tree.nodes.get(str(conflict.get("node", "")))
            what = str(conflict.get("field") or conflict.get("op") or "?")
            sides = {side: _shown(conflict.get(side)) for side in ("ours", "theirs")}
            context.report("BT0116", tree, node, what=what[:LONGEST], **sides)


def conflicts_of(tree: Tree) -> tuple[Mapping[str, Any], ...]:
    """Returns the conflicts of a diagram, or of a tree in XML."""
    if (text := tree.attributes.get(CONFLICTS)) is None:
        return tree.conflicts
    try:
        rows = json.loads(text)
    except (ValueError, RecursionError):
        rows = None
    if not isinstance(rows, list):
        rows = [{}]
    return (*tree.conflicts, *(row if isinstance(row, dict) else {} for row in rows))


def sentence(conflict: Mapping[str, Any]) -> str:
    """Returns a conflict on one line, for the command line."""
    node = f" [{shown(str(conflict['node']))}]" if conflict.get("node") else ""
    what = shown(str(conflict.get("field") or conflict.get("op") or "?"))
    return f"{what}{node}: ours {_shown(conflict.get('ours'))}, theirs {_shown(conflict.get('theirs'))}"


def _shown(value: Any) -> str:
    if value is None:
        return "∅"
    text = value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    return f"“{shown(text)}”"
