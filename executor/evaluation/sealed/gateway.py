"""The world's ROS node in the process of the actions: real publishers and subscriptions, without a world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from executor.evaluation.sealed.link import Heard
from executor.navigation.node import ACTIONS, MAP_TOPIC, SERVICES
from executor.ros.raw_take import ignore, take
from executor.ros.values import message_type, type_name

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.context import Context

    from executor.evaluation.sealed.link import Sent, Topic


class Gateway:
    """Publishes what the world sends, and hears what the actions command."""

    def __init__(self, context: Context, publishers: Iterable[Topic], subscriptions: Iterable[Topic]) -> None:
        self.node = Node(
            "world",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        self._publishers = [
            self.node.create_publisher(message_type(topic.types[0]), topic.name, _qos(topic))
            for topic in publishers
        ]
        self._topics = {topic.name: topic for topic in subscriptions}
        self._subscriptions = {
            topic.name: self._subscribe(message_type(topic.types[0]), topic)
            for topic in self._topics.values()
        }

    def publish(self, sent: Iterable[Sent]) -> None:
        """Publishes messages of the world."""
        for each in sent:
            self._publishers[each.publisher].publish(each.data)

    def listeners(self) -> list[int]:
        """Returns the number of subscribers of each publisher."""
        return [publisher.get_subscription_count() for publisher in self._publishers]

    def heard(self) -> list[Heard]:
        """Returns the messages that have arrived, with their types."""
        found = []
        for topic, subscription in self._subscriptions.items():
            while (data := take(subscription)) is not None:
                found.append(Heard(topic, type_name(subscription.msg_type), data))
        return found

    def make_way(self, topic: str, message_type: type) -> None:
        """Changes the type of a subscription, for a node of this participant (`share_commands`)."""
        known = self._topics.get(topic)
        name = type_name(message_type)
        if known is None or name not in known.types or name == type_name(self._subscriptions[topic].msg_type):
            return
        self.node.destroy_subscription(self._subscriptions[topic])
        self._subscriptions[topic] = self._subscribe(message_type, known)

    def navigation_in_use(self) -> str:
        """Returns the name of Nav2 that the actions use, or an empty text: a sealed run has no navigation."""
        for name in ACTIONS:
            if self.node.count_clients(f"{name}/_action/send_goal"):
                return name
        used = next((name for name in SERVICES if self.node.count_clients(name)), "")
        return used or (MAP_TOPIC if self.node.count_subscribers(MAP_TOPIC) else "")

    def close(self) -> None:
        """Leaves the graph."""
        self.node.destroy_node()

    def _subscribe(self, kind: Any, topic: Topic) -> Any:
        return self.node.create_subscription(kind, topic.name, ignore, topic.depth, raw=True)


def _qos(topic: Topic) -> QoSProfile:
    durability = DurabilityPolicy.TRANSIENT_LOCAL if topic.is_latched else DurabilityPolicy.VOLATILE
    return QoSProfile(depth=topic.depth, durability=durability)
