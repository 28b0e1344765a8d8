"""The fault `action_raises`: makes an action of a loaded tree raise when it is ticked."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from tree_gardener import Tree

MESSAGE: Final = "a fault of the evaluation makes this action raise"


def switch_action(tree: Tree, tree_id: str, node_id: str, *, on: bool) -> None:
    """Makes an action raise, or ends that."""
    for node in tree.nodes:
        behaviour: Any = getattr(node, "instance_behaviour", None)
        if behaviour is not None and (node.tree_id, node.node_id) == (tree_id, node_id):
            leaf: Any = node
            leaf.replace_update(_raise if on else behaviour.update)


def _raise() -> Any:
    raise RuntimeError(MESSAGE)
