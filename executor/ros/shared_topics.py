"""Adapts the world's command topics to an application in the same participant.

The world subscribes with the application's message type.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, Final, Protocol

from rclpy.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

_MAKERS: Final = ("create_publisher", "create_subscription")


class CommandEnds(Protocol):
    """The owner of the command subscriptions: the world's node, or its substitute in a sealed run."""

    node: Node

    def make_way(self, topic: str, message_type: type) -> None:
        """Changes the type of a subscription."""
        ...


def share_commands(world: CommandEnds, context: Context) -> Callable[[], None]:
    """From now on, changes the world's subscription when a node of `context` uses a command topic.

    A participant supports one type for a topic, and the choice of the application is not known in advance.
    Returns a function that undoes this.
    """
    originals = {name: getattr(Node, name) for name in _MAKERS}
    for name, original in originals.items():
        setattr(Node, name, _making_way(original, world, context))

    def undo() -> None:
        for name, original in originals.items():
            setattr(Node, name, original)

    return undo


def _making_way(original: Any, world: CommandEnds, context: Context) -> Any:
    @functools.wraps(original)
    def make(node: Any, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> Any:
        if node.context is context and node is not world.node:
            world.make_way(node.resolve_topic_name(topic), msg_type)
        return original(node, msg_type, topic, *args, **kwargs)

    return make
