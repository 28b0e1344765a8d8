"""Backups of a tree's blackboard, as BehaviorTree.CPP's ``BlackboardBackup`` and ``BlackboardRestore``."""

from typing import TYPE_CHECKING, Any, NamedTuple

from tree_gardener.blackboard import Entry
from tree_gardener.values import ValueType

if TYPE_CHECKING:
    from tree_gardener.tree import Tree


class Saved(NamedTuple):
    """The type and the value of an entry."""

    type: ValueType | None
    value: Any


Backup = tuple[dict[str, Saved], ...]
"""The entries of each scope, in the order of the tree's scopes."""


def backup(tree: "Tree") -> Backup:
    """Returns the entries of all scopes.

    Lists, dicts and sets are copied; other objects are kept by reference, as shared pointers are in C++.
    """
    return tuple(
        {key: Saved(entry.type, _copied(entry.value)) for key, entry in board.entries.items()}
        for board in tree.boards
    )


def restore(tree: "Tree", saved: Backup) -> None:
    """Gives all scopes the entries of a backup; entries that came since are removed.

    To restore an entry that exists counts as an update.

    Raises:
        ValueError: the backup is of another tree, with more or fewer SubTrees.
    """
    if len(saved) != len(tree.boards):
        raise ValueError(f"the backup has {len(saved)} scopes, and the tree has {len(tree.boards)}")
    for board, entries in zip(tree.boards, saved, strict=True):
        for key in [key for key in board.entries if key not in entries]:
            board.unset(key)
        for key, (kind, value) in entries.items():
            entry = board.entries.get(key)
            is_new = entry is None
            if entry is None:
                entry = board.entries[key] = Entry(board, key, kind)
            entry.type = kind
            entry.write(_copied(value))
            if is_new:
                entry.sequence = 0


def _copied(value: Any) -> Any:
    """Copies containers of values; a container of another class, such as a SharedQueue, is shared."""
    if type(value) in (list, tuple, set):
        return type(value)(_copied(item) for item in value)
    if type(value) is dict:
        return {key: _copied(item) for key, item in value.items()}
    return value
