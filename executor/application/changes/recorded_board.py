"""Gives a tree that has not ticked yet the blackboard of a recording."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tree_gardener import Tree

__all__ = ["restore", "said_of"]

_MOST_NAMED: Final = 20
_PREVIEW: Final = "preview"
_PLAIN: Final = frozenset(("bool", "int", "double", "string", "NoneType", "list", "dict", "float", "str"))
"""The types whose values a recording holds as they are."""


def restore(tree: Tree, blackboard_json: str) -> list[str]:
    """Writes the recorded entries, and returns the names of those that are left empty.

    Left empty are values without a JSON form, those of which the recording holds only a preview, and entries
    whose scope or type the tree does not have any more.

    Args:
        tree: the tree.
        blackboard_json: rows of scope, key, type and value, as a keyframe has them.

    Raises:
        ValueError: it is no such list.
    """
    rows = json.loads(blackboard_json)
    if not isinstance(rows, list):
        raise ValueError("the recorded blackboard is no list")
    empty: list[str] = []
    for row in rows:
        match row:
            case [str(scope), str(key), str(kind), value]:
                if kind != "empty" and not _write(tree, scope, key, kind, value):
                    empty.append(f"{scope}/{key}" if scope else key)
            case _:
                raise ValueError("an entry of the recorded blackboard is not one")
    return empty


def said_of(empty: Sequence[str]) -> str:
    """Returns the sentence about entries that were left empty."""
    more = f", and {len(empty) - _MOST_NAMED} more" if len(empty) > _MOST_NAMED else ""
    names = ", ".join(empty[:_MOST_NAMED])
    return f"Left empty, since the recording does not hold these values: {names}{more}."


def _write(tree: Tree, scope: str, key: str, kind: str, value: Any) -> bool:
    """Writes an entry; returns whether that is possible."""
    from tree_gardener.errors import PortError  # noqa: PLC0415 - as all of the engine, with the tree
    from tree_gardener.py_trees_board import PREFIX, STATUS, write  # noqa: PLC0415 - as above

    if isinstance(value, dict) and isinstance(value.get(_PREVIEW), str):
        return False
    if kind in ("double", "float") and type(value) is int:
        value = float(value)
    if scope.startswith(PREFIX):
        return kind == STATUS or (kind in _PLAIN and write(scope, key, value))
    try:
        board = tree.blackboard.scope(scope)
    except KeyError:
        return False
    entry = board.entries.get(key)
    is_strong = entry is not None and entry.is_strong
    if not is_strong and kind not in _PLAIN:
        return False  # an object of a class has another form than its JSON
    try:
        board[key] = value
    except (PortError, TypeError, ValueError):
        return False
    return True
