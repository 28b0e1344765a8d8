"""Reads which files the trees and actions of a project name, for the list of trees that projects offer."""

from __future__ import annotations

import json
import re
from typing import Any, Final

OFFERED: Final = "_bts_offered"
"""The attribute of a tree that offers it; its value is "1"."""
_WORD: Final = re.compile(r"\w+")

Answer = dict[str, Any]


def uses(trees: dict[str, str], actions: dict[str, str]) -> Answer:
    """Returns what the texts name, by their keys.

    `used` has the files that the blocks of a tree name, and the words of an action; `offered` the trees that
    are offered.
    """
    read = {key: _tree(text) for key, text in trees.items()}
    used = {key: sorted(paths) for key, (paths, _) in read.items()}
    used |= {key: sorted(set(_WORD.findall(text))) for key, text in actions.items()}
    return {"used": used, "offered": [key for key, (_, is_offered) in read.items() if is_offered]}


def _tree(text: str) -> tuple[set[str], bool]:
    try:
        diagram = json.loads(text)
    except (ValueError, RecursionError):
        return set(), False
    if not isinstance(diagram, dict):
        return set(), False
    nodes, attributes = diagram.get("nodes"), diagram.get("attributes")
    found = nodes.values() if isinstance(nodes, dict) else ()
    blocks = [node for node in found if isinstance(node, dict)]
    paths = {
        f"trees/{node.get('tree')}.json"
        if node.get("type") == "SubTree"
        else f"actions/{node.get('type')}.py"
        for node in blocks
    }
    return paths, isinstance(attributes, dict) and attributes.get(OFFERED) == "1"
