"""Publishers and subscriptions of an application on the topics of commands.

A participant of the middleware holds one type for a topic. So the world subscribes with the application's
type where both are in one participant, and a second type in an application is refused before the middleware
prints its own error. Where the world is in another participant, it makes its subscription to `TwistStamped`
once somebody publishes that; the publisher waits for it, so that the first commands arrive.
"""

from __future__ import annotations

import functools
import time
from typing import TYPE_CHECKING, Any, Final, Protocol

from geometry_msgs.msg import TwistStamped
from rclpy.node import Node

from executor.ros.values import type_name

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

_MAKERS: Final = ("create_publisher", "create_subscription")
WAIT_S: Final = 1.0
"""The longest wait of a publisher; with our profile of the middleware it is about 0.2 s."""
_LOOK_S: Final = 0.005


class TopicTypeError(ValueError):
    """A second type on a topic of one program."""


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

    def before(topic: str, message_type: type) -> None:
        world.make_way(topic, message_type)

    return _patched(world.node, context, before, lambda _: None, world=world.node)


def await_commands(node: Node, wait_s: float = WAIT_S) -> Callable[[], None]:
    """From now on, a publisher of `TwistStamped` in the context of `node` waits for its robot.

    The robot's subscription of that type is made when somebody publishes it, in another process.
    Returns a function that undoes this.
    """

    def after(publisher: Any) -> None:
        if publisher.msg_type is not TwistStamped:
            return
        end_s = time.monotonic() + wait_s
        # A robot is there if it takes commands of the other type.
        while (
            node.count_subscribers(publisher.topic_name)
            and not publisher.get_subscription_count()
            and time.monotonic() < end_s
        ):
            time.sleep(_LOOK_S)

    return _patched(node, node.context, lambda _topic, _kind: None, after)


def _patched(
    observer: Node,
    context: Context,
    before: Callable[[str, type], None],
    after: Callable[[Any], None],
    *,
    world: Node | None = None,
) -> Callable[[], None]:
    """Calls functions around what makes publishers and subscriptions in a context, but for the world's node.

    Returns a function that undoes this.
    """
    originals = {name: getattr(Node, name) for name in _MAKERS}
    users: set[tuple[str, str]] = set()

    def wrapped(name: str, original: Any) -> Any:
        @functools.wraps(original)
        def make(node: Any, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> Any:
            if node.context is not context or node is world:
                return original(node, msg_type, topic, *args, **kwargs)
            full_name = node.resolve_topic_name(topic)
            if isinstance(msg_type, type):
                _refuse_second_type(observer, full_name, msg_type, users)
            before(full_name, msg_type)
            users.add((node.get_name(), node.get_namespace()))
            made = original(node, msg_type, topic, *args, **kwargs)
            if name == "create_publisher":
                after(made)
            return made

        return make

    for name, original in originals.items():
        setattr(Node, name, wrapped(name, original))

    def undo() -> None:
        for name, original in originals.items():
            setattr(Node, name, original)

    return undo


def _refuse_second_type(node: Node, topic: str, kind: type, users: set[tuple[str, str]]) -> None:
    """Raises TopicTypeError if one of these nodes uses a topic with another type."""
    ends = (*node.get_publishers_info_by_topic(topic), *node.get_subscriptions_info_by_topic(topic))
    wanted = type_name(kind)
    for end in ends:
        is_ours = (end.node_name, end.node_namespace) in users
        if is_ours and end.topic_type.split("/")[::2] != wanted.split("/")[::2]:
            raise TopicTypeError(
                f"{topic} is of the type {end.topic_type} in this program already, so it cannot be of"
                f" {wanted} too: a program holds one type for a topic; use one of them in all actions"
            )
