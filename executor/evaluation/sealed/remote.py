"""The world's ROS node in a sealed run: it is in no graph, and its messages go through the link.

It has the part of rclpy's `Node` that `WorldNode` uses. The real publishers and subscriptions are in the
process of the actions (`gateway`), so no participant of the middleware exists beside the world.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, Any

from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message

from executor.evaluation.sealed.link import Sent, Topic
from executor.ros.values import type_name

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from executor.evaluation.sealed.link import Heard


class RemoteNode:
    """A node whose ends are elsewhere.

    Attributes:
        publishers: the topics of its publishers, in order.
        subscriptions: its subscriptions by topic.
        listeners: the number of subscribers of each publisher, as the other process last said.
    """

    context = None

    def __init__(self) -> None:
        self.publishers: list[Topic] = []
        self.subscriptions: dict[str, RemoteSubscription] = {}
        self.listeners: list[int] = []
        self._sent: list[Sent] = []

    def create_publisher(self, kind: type, topic: str, qos: QoSProfile | int) -> RemotePublisher:
        """Returns a publisher, as rclpy's method does."""
        depth, is_latched = _read_qos(qos)
        self.publishers.append(Topic(topic, (type_name(kind),), depth, is_latched))
        self.listeners.append(0)
        return RemotePublisher(self, len(self.publishers) - 1, topic)

    def create_subscription(
        self,
        kind: type,
        topic: str,
        _callback: Callable[[Any], None],
        qos: QoSProfile | int,
        *,
        raw: bool = False,
    ) -> RemoteSubscription:
        """Returns a subscription, as rclpy's method does."""
        found = self.subscriptions[topic] = RemoteSubscription(kind, topic, _read_qos(qos)[0], raw=raw)
        return found

    def destroy_subscription(self, subscription: RemoteSubscription) -> bool:
        """Forgets a subscription."""
        return self.subscriptions.pop(subscription.topic, None) is not None

    def destroy_node(self) -> None:
        """Does nothing: there is no node."""

    def get_publishers_info_by_topic(self, _topic: str) -> list[Any]:
        """Returns no publishers: a command's type is known from the command."""
        return []

    def add(self, publisher: int, data: bytes) -> None:
        """Keeps a message until it is taken."""
        self._sent.append(Sent(publisher, data))

    def take_sent(self) -> list[Sent]:
        """Returns the messages that were published since the last call, in order."""
        sent, self._sent = self._sent, []
        return sent

    def hear(
        self, listeners: list[int], heard: Iterable[Heard], make_way: Callable[[str, str], None]
    ) -> None:
        """Takes in what the other process says: numbers of subscribers, and messages.

        Args:
            listeners: the number of subscribers of each publisher; a list of another length is ignored.
            heard: the messages; those of other topics are ignored.
            make_way: called with topic and type of each message before it is taken in.
        """
        if len(listeners) == len(self.publishers):
            self.listeners = listeners
        for each in heard:
            make_way(each.topic, each.type)
            subscription = self.subscriptions.get(each.topic)
            if subscription is not None and type_name(subscription.msg_type) == each.type:
                subscription.add(each.data)


class RemotePublisher:
    """A publisher of a `RemoteNode`."""

    def __init__(self, node: RemoteNode, number: int, topic: str) -> None:
        self._node = node
        self._number = number
        self.topic_name = topic

    def publish(self, message: Any) -> None:
        """Sends a message with the next request."""
        self._node.add(self._number, serialize_message(message))

    def get_subscription_count(self) -> int:
        """Returns the number of subscribers in the other process."""
        return self._node.listeners[self._number]


class RemoteSubscription:
    """A subscription of a `RemoteNode`; it is its own handle."""

    def __init__(self, kind: type, topic: str, depth: int, *, raw: bool = False) -> None:
        self.msg_type = kind
        self.raw = raw
        self.topic = topic
        self.depth = depth
        self._waiting: deque[bytes] = deque(maxlen=depth)

    @property
    def handle(self) -> RemoteSubscription:
        """The handle that `raw_take` reads."""
        return self

    def __enter__(self) -> RemoteSubscription:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def add(self, data: bytes) -> None:
        """Adds a message; the oldest one is dropped if there are too many."""
        self._waiting.append(data)

    def take_message(self, kind: type, raw: bool) -> tuple[Any, dict[str, Any]] | None:  # noqa: FBT001 - as rclpy's
        """Returns the next message that can be read, or its bytes if it is wanted raw; or None."""
        while self._waiting:
            data = self._waiting.popleft()
            try:
                message = deserialize_message(data, kind)
                return (data if raw else message), {}
            except Exception:  # noqa: S112 - the bytes are no message of the type, as any program can send
                continue
        return None


def _read_qos(qos: QoSProfile | int) -> tuple[int, bool]:
    if isinstance(qos, int):
        return qos, False
    return qos.depth, qos.durability is DurabilityPolicy.TRANSIENT_LOCAL
