"""Backups of a tree's blackboard, as BehaviorTree.CPP's ``BlackboardBackup`` and ``BlackboardRestore``."""

from typing import TYPE_CHECKING, Any, Final, NamedTuple

from tree_gardener.blackboard import Entry
from tree_gardener.values import ValueType

if TYPE_CHECKING:
    from tree_gardener.tree import Tree


class Saved(NamedTuple):
    """The type and the value of an entry."""

    type: ValueType | None
    value: Any


_LEVELS: Final = 100
"""Levels of containers within containers that are copied."""

Backup = tuple[dict[str, Saved], ...]
"""The entries of each scope, in the order of the tree's scopes."""


def backup(tree: "Tree") -> Backup:
    """Returns the entries of all scopes.

    Lists, dicts and sets are copied; other objects are kept by reference, as shared pointers are in C++.

    Raises:
        ValueError: an entry is nested too deeply, as a list that holds itself is.
    """
    return tuple(
        {key: Saved(entry.type, _Copy(key).of(entry.value)) for key, entry in board.entries.items()}
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
            entry.write(_Copy(key).of(value))
            if is_new:
                entry.sequence = 0


class _Copy:
    """The copy of one entry, in which what several containers share stays shared."""

    def __init__(self, key: str) -> None:
        self._key = key
        self._copies: dict[int, Any] = {}

    def of(self, value: Any, levels: int = _LEVELS) -> Any:
        """Copies containers of values; a container of another class, such as a SharedQueue, is shared."""
        kind: Any = type(value)
        if kind not in (list, tuple, set, dict):
            return value
        if id(value) in self._copies:
            return self._copies[id(value)]
        if not levels:
            raise ValueError(f"the entry '{self._key}' is nested too deeply")
        if kind is dict:
            copy = {key: self.of(item, levels - 1) for key, item in value.items()}
        else:
            copy = kind([self.of(item, levels - 1) for item in value])
        self._copies[id(value)] = copy
        return copy
