"""Changes ports of the running tree between two ticks, and reports the new texts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from tree_gardener import PortRefusedError
from tree_gardener import set_port as change_port

if TYPE_CHECKING:
    from collections.abc import Callable

    from tree_gardener import Tree
    from tree_gardener.node import Node

__all__ = ["set_port"]

READ_AT_LOAD: Final = "TG308"


def set_port(
    tree: Tree, change: child_messages.SetPort, send: Callable[[child_messages.PortSet], None]
) -> messages.Error | None:
    """Gives a port another text and reports it; returns the error if it is refused."""
    node = _node_at(tree, change.node_id, change.path)
    if node is None:
        message = f"The running tree has no node '{change.path}'."
        return messages.Error("unknown_node", message, "Start the program again to use the new tree.")
    try:
        effect = change_port(node, change.port, change.value)
    except PortRefusedError as refused:
        found = refused.diagnostic
        code = "port_fixed" if found.code == READ_AT_LOAD else "bad_port"
        return messages.Error(code, f"'{node.path}': {found.message}.", _sentence(found.hint))
    send(
        child_messages.PortSet(
            node_id=node.node_id,
            tree_id=node.tree_id,
            path=node.path,
            port=change.port,
            value=change.value,
            saved=node.attributes.get(change.port),
            effect=effect.value,
        )
    )
    return None


def _node_at(tree: Tree, node_id: str, path: str) -> Node | None:
    """Returns the node; two nodes of one name have the same path, and different ids."""
    return next((node for node in tree.nodes if node.node_id == node_id and node.path == path), None)


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}." if text else ""
