"""Publishing as a node, after ``RosTopicPubNode`` of BehaviorTree.ROS2."""

from typing import Any, ClassVar

from tree_gardener.ros_nodes.leaf import RosLeaf
from tree_gardener.status import Status


class RosPublish(RosLeaf):
    """Publishes one message at each tick; its fields are ports. Always succeeds."""

    NODE_KIND: ClassVar[str] = "SyncAction"

    _type: Any = None
    _publisher: Any = None
    _made_for = ("", False)

    def setup(self, **kwargs: Any) -> None:
        """Makes the publisher, if the topic is known already."""
        super().setup(**kwargs)
        if self.ros is not None and self.literal("topic_type"):
            self._resolve()
            self.check_fields(self._type(), "message")
            if self.literal("topic_name"):
                self._advertise()

    def update(self) -> Status:
        """Publishes the message."""
        self._resolve()
        self._advertise()
        self._publisher.publish(self.fill(self._type(), "message"))
        return Status.SUCCESS

    def shutdown(self) -> None:
        """Destroys the publisher."""
        if self._publisher is not None:
            self.ros.destroy_publisher(self._publisher)
            self._publisher = None

    def _resolve(self) -> None:
        if self._type is None:
            self.joined()
            self._type = self.interface("topic_type", "", "msg")

    def _advertise(self) -> None:
        wanted = self.ros_name("topic_name", ""), self.flag("latched", default=False)
        if self._publisher is None or wanted != self._made_for:
            self.shutdown()
            self._publisher = self.joined().create_publisher(
                self._type, wanted[0], quality(latched=wanted[1])
            )
            self._made_for = wanted


def quality(*, latched: bool = False, sensor: bool = False) -> Any:
    """Returns a quality of service; `latched` keeps messages for those who subscribe later."""
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy  # noqa: PLC0415 - needs ROS

    return QoSProfile(
        depth=10,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
        reliability=ReliabilityPolicy.BEST_EFFORT if sensor else ReliabilityPolicy.RELIABLE,
    )
