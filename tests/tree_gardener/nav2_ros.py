"""A ROS node without a graph for the tests of Nav2's nodes; messages are those of ROS."""

from __future__ import annotations

from contextlib import nullcontext
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, TransformStamped, Twist, Vector3
from nav_msgs.msg import Goals, Odometry, Path
from rclpy.clock import Clock
from std_msgs.msg import Header

from executor.application import compat
from tests.tree_gardener.nav2_trees import nav2_tree
from tree_gardener import ManualClock, Status, Tree

if TYPE_CHECKING:
    from collections.abc import Callable

compat.install()


class Subscription:
    """A subscription whose queue is empty: messages are delivered at once."""

    def __init__(self, topic: str, callback: Callable[[Any], None]) -> None:
        self.topic, self.callback = topic, callback
        self.raw = False
        self.msg_type: Any = None
        self.handle = nullcontext()
        self.handle.take_message = lambda *_about: None  # type: ignore[attr-defined]


class RosNode:
    """Delivers what is published to the subscriptions made on it."""

    def __init__(self, **parameters: Any) -> None:
        self.parameters = parameters
        self.topics: dict[str, list[Callable[[Any], None]]] = {}
        self.clock = Clock()
        self.executor = SimpleNamespace(holds_time=True)  # as in lock-step: a look-up does not wait

    def create_subscription(
        self, _kind: Any, topic: str, callback: Callable[[Any], None], _qos: Any, **_more: Any
    ) -> Any:
        self.topics.setdefault(topic, []).append(callback)
        return Subscription(topic, callback)

    def destroy_subscription(self, subscription: Any) -> None:
        self.topics[subscription.topic].remove(subscription.callback)

    def create_service(self, *_arguments: Any, **_more: Any) -> None:
        """The buffer of transforms offers one."""

    def get_clock(self) -> Clock:
        return self.clock

    def has_parameter(self, name: str) -> bool:
        return name in self.parameters

    def get_parameter(self, name: str) -> Any:
        return SimpleNamespace(value=self.parameters[name])

    def publish(self, topic: str, message: Any) -> None:
        for callback in self.topics[topic]:
            callback(message)

    def place(self, x: float, y: float = 0.0, *, frame: str = "map", base: str = "base_link") -> None:
        """Publishes where the robot is, by tf."""
        transform = TransformStamped(header=Header(frame_id=frame), child_frame_id=base)
        transform.transform.translation = Vector3(x=x, y=y, z=0.0)
        transform.transform.rotation.w = 1.0
        self.publish("/tf_static", SimpleNamespace(transforms=[transform]))

    def forget_places(self) -> None:
        """Empties the buffer of transforms that the nodes share."""
        vars(self)["nav2_buffer"].clear()


def pose(x: float, y: float = 0.0, *, frame: str = "map", sec: int = 0) -> PoseStamped:
    """A stamped pose."""
    header = Header(frame_id=frame)
    header.stamp.sec = sec
    place = Pose(position=Point(x=x, y=y, z=0.0), orientation=Quaternion(x=0.0, y=0.0, z=0.0, w=1.0))
    return PoseStamped(header=header, pose=place)


def path(*points: float, frame: str = "map") -> Path:
    """A path along the x axis."""
    return Path(header=Header(frame_id=frame), poses=[pose(x, frame=frame) for x in points])


def goals(*points: float, sec: int = 0) -> Goals:
    """Goals along the x axis."""
    header = Header(frame_id="map")
    header.stamp.sec = sec
    return Goals(header=header, goals=[pose(x) for x in points])


def odometry(speed: float, time_s: float = 0.0) -> Odometry:
    """A message of odometry."""
    message = Odometry()
    message.header.stamp.sec = int(time_s)
    message.header.stamp.nanosec = round(time_s % 1.0 * 1e9)
    message.twist.twist = Twist(linear=Vector3(x=speed, y=0.0, z=0.0))
    return message


def xs(message: Any) -> list[float]:
    """Where the poses of a path, or the goals, are."""
    poses = message.poses if hasattr(message, "poses") else message.goals
    return [each.pose.position.x for each in poses]


class Trial:
    """A tree whose root is a node of Nav2, with the entries of its blackboard.

    Args:
        cls: The node.
        ports: Its ports as XML.
        children: The results of its child, one letter for each tick.
        ros: The ROS node.
        entries: The blackboard.
    """

    def __init__(
        self,
        cls: type,
        ports: str = "",
        *,
        children: str = "",
        ros: RosNode | None = None,
        **entries: Any,
    ) -> None:
        self.clock = ManualClock()
        self.tree: Tree = nav2_tree(cls, [children] if children else [], ports, clock=self.clock)
        for key, value in entries.items():
            self.tree.blackboard[key] = value
        self.tree.setup(node=ros)

    def tick(self) -> str:
        """Returns the letter of a tick after a reset, as under a parent that has ended."""
        return self.tree.tick_exactly_once().letter

    def again(self) -> str:
        """Returns the letter of a tick while the node is still active, as under a parent that is RUNNING."""
        self.tree.nodes[0].status = Status.RUNNING
        return self.tick()

    @property
    def child_ticks(self) -> int:
        """The number of ticks of the child."""
        count: int = self.tree.nodes[1].behaviour.calls.count("update")
        return count

    def __getitem__(self, key: str) -> Any:
        return self.tree.blackboard[key]

    def __setitem__(self, key: str, value: Any) -> None:
        self.tree.blackboard[key] = value
