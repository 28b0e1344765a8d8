"""Closes the ROS entities that a tree opened on a node that outlives it.

Most actions leave their publishers and subscriptions to the end of the process. A node that runs one tree
after the other would keep those of every tree.
"""

import contextlib
from typing import Any, Final

_KINDS: Final = (
    ("timers", "destroy_timer"),
    ("subscriptions", "destroy_subscription"),
    ("clients", "destroy_client"),
    ("services", "destroy_service"),
    ("publishers", "destroy_publisher"),
    ("guards", "destroy_guard_condition"),
)


class OpenedSince:
    """Remembers the entities of a node, so that those opened later can be closed."""

    def __init__(self, node: Any) -> None:
        self._node = node
        self._kept = {id(each) for each in _all(node)}
        self._parameters = set(_parameters(node))

    def close(self) -> None:
        """Destroys the entities opened since, and undeclares the parameters."""
        node = self._node
        for waitable in list(node.waitables):  # clients and servers of actions
            if id(waitable) not in self._kept and hasattr(waitable, "destroy"):
                waitable.destroy()
        for kind, destroy in _KINDS:
            for each in list(getattr(node, kind)):
                if id(each) not in self._kept:
                    getattr(node, destroy)(each)
        for name in set(_parameters(node)) - self._parameters:
            with contextlib.suppress(Exception):  # a read-only one stays; the action that declares it says so
                node.undeclare_parameter(name)


def _all(node: Any) -> list[Any]:
    kinds = [getattr(node, kind) for kind, _ in _KINDS]
    return [each for kind in [*kinds, node.waitables] for each in kind]


def _parameters(node: Any) -> list[str]:
    return list(node.get_parameters_by_prefix(""))
