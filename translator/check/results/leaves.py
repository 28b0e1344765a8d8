"""The results of leaves: the built-in ones, those of ROS, and actions by their Python."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.action_returns import returns_of
from translator.check.results.sets import ALL, DONE, NAMES, F, K, R, S, literal, set_of, whole
from translator.tree import pointer

if TYPE_CHECKING:
    from translator.action import ActionModel
    from translator.tree import Node

_FIXED: Final = {
    "AlwaysSuccess": S,
    "AlwaysFailure": F,
    "Script": S,
    "ScriptCondition": DONE,
    "UnsetBlackboard": S,
    "WasEntryUpdated": DONE,
    "TestNode": ALL,
    "RosPublish": S,
    "TfLookup": DONE | R,
}
_MISSING: Final = frozenset({"RosAction", "RosService", "RosParam"})
"""The nodes of ROS whose port `if_missing` holds the result without a server."""


def of_leaf(node: Node) -> int | None:
    """Returns the set of a built-in leaf; None for another node."""
    fixed = _FIXED.get(node.type)
    if fixed is not None:
        return fixed
    if node.type == "SetBlackboard":
        # It fails if the entry from which it copies has no value.
        return DONE if pointer(node.ports.get("value", ""), "value") is not None else S
    if node.type == "Sleep":
        duration = whole(node, "msec")
        return S if duration is not None and duration <= 0 else S | R
    if node.type in _MISSING:
        missing = literal(node, "if_missing", "FAILURE")
        return DONE | R | (K if missing is None else NAMES.get(missing.strip(), K))
    if node.type == "RosSubscribe":
        mode = literal(node, "mode", "latest")
        return DONE if mode is not None and mode.strip() != "wait" else DONE | R
    return None


def of_action(action: ActionModel) -> tuple[int, int]:
    """Returns the set of results of an action or a control node of the project, and of those it names.

    The first holds every result that it may return; the second only those that its Python states, so that
    it really can return them.
    """
    from tree_gardener.stubs import is_stub  # noqa: PLC0415 - the engine loads py_trees

    if is_stub(action.source):
        return ALL, 0  # what it returns now says nothing of what it is to do
    returns = returns_of(action.source, action.name)
    allowed = ALL & ~R if action.kind == "condition" or returns.is_sync else ALL
    named = set_of(returns.named) & allowed
    return (set_of(returns.known) or ALL) & allowed, named
