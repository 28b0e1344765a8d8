"""Where the application is in the world's participant: the world leaves topics of commands to its types."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, Final

from rclpy.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

    from executor.ros.node import WorldNode

_MAKERS: Final = ("create_publisher", "create_subscription")


def share_commands(world: WorldNode, context: Context) -> Callable[[], None]:
    """Has the world make way before a node of `context` takes part in a topic of commands.

    A participant holds one type for a topic, and which one the application will choose is not known before.
    Returns what undoes it.
    """
    originals = {name: getattr(Node, name) for name in _MAKERS}
    for name, original in originals.items():
        setattr(Node, name, _making_way(original, world, context))

    def undo() -> None:
        for name, original in originals.items():
            setattr(Node, name, original)

    return undo


def _making_way(original: Any, world: WorldNode, context: Context) -> Any:
    @functools.wraps(original)
    def make(node: Any, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> Any:
        if node.context is context and node is not world.node:
            world.make_way(node.resolve_topic_name(topic), msg_type)
        return original(node, msg_type, topic, *args, **kwargs)

    return make
