"""Writes an entry of the blackboard for a person who watches the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from tree_gardener import Tree

__all__ = ["write"]


def write(tree: Tree, scope: str, key: str, value: Any) -> str:
    """Writes an entry; returns why that is not possible, or "".

    Args:
        tree: the tree that runs.
        scope: the scope of the entry: the path of a subtree, or "" for the root's.
        key: the name of the entry.
        value: its new value, from JSON.
    """
    from tree_gardener.errors import PortError  # noqa: PLC0415 - as all of the engine, with the tree
    from tree_gardener.py_trees_board import PREFIX  # noqa: PLC0415 - as above

    if scope.startswith(PREFIX):
        return f"The entry '{key}' is one of py_trees: only its clients can write it."
    try:
        board = tree.blackboard.scope(scope) if scope else tree.blackboard
        # JSON has only one kind of number: writing 1 over 0.5 must keep a double.
        is_double = isinstance(board.get(key), float) and type(value) is int
        board[key] = float(value) if is_double else value
    except KeyError:
        return f"There is no subtree {scope!r}."
    except PortError as error:
        return f"The {error}."
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return ""
