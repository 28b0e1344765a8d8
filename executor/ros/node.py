"""The ROS node of a world: it receives `/cmd_vel`, and publishes sensors, odometry and time.

It needs no executor.

There are no callbacks: `poll` reads messages, `publish` sends the messages that are due. So the world's loop
has one thread and a defined order, and the same node serves real time and lock-step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import rclpy
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock

from executor.ros import messages
from executor.ros.environment import has_tf
from executor.ros.feed import SHOWN_HZ, Coded, Due, Feed, Feeds
from executor.ros.outlet import Outlet, Piped
from executor.ros.raw_take import take
from executor.ros.robot_topics import LATCHED_QOS, ODOMETRY_HZ, RobotTopics
from executor.ros.transform_rows import TF_TYPE, encode_transforms

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from executor.ros.feed import Tap
    from executor.ros.topic_faults import TopicFaults
    from executor.ros.transform_rows import Row
    from executor.world.interface import Robot, World
    from executor.world.physics.bullet import BulletWorld
    from executor.world.sensing.sensors import Sensors

__all__ = ["CLOCK_HZ", "Due", "WorldNode", "take"]

CLOCK_HZ: Final = 60.0
_CLOCK_QOS: Final = QoSProfile(depth=10)
_TF_QOS: Final = QoSProfile(depth=100)


class WorldNode:
    """Publishes and receives the topics of a world and of its robots.

    Args:
        world: the world.
        context: the ROS context.
        topics: topics that the universe renames, by robot and sensor.
        true_poses: the robots that publish their true pose.
        clock_hz: the rate of `/clock`.
        outlet: the outlet through which messages are published; None publishes directly.
        node: takes the place of a node of rclpy, as in sealed runs.
    """

    def __init__(  # noqa: PLR0913 - a world, and how it takes part in the graph
        self,
        world: World,
        context: Context,
        *,
        topics: dict[str, dict[str, str]] | None = None,
        true_poses: Collection[str] = (),
        clock_hz: float = CLOCK_HZ,
        outlet: Outlet | None = None,
        node: Any = None,
    ) -> None:
        self._world = world
        self._outlet = outlet
        self.node = node or Node(
            "world",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        self._clock = self._publisher(Clock, "/clock", _CLOCK_QOS)
        self._clock_due = Due(clock_hz)
        renamed = topics or {}
        self._second: Node | None = None
        self._robots = [
            RobotTopics(
                self.node,
                self._finder(i),
                i,
                renamed.get(robot.id, {}),
                self._second_node,
                ground_truth=robot.id in true_poses,
                outlet=outlet,
            )
            for i, robot in enumerate(world.robots)
        ]
        feeds = [feed for robot in self._robots for feed in robot.feeds]
        self._static: Any = None
        if has_tf():
            feeds.append(self._make_tf())
        self._feeds = Feeds(feeds)
        self._pictures = [feed for feed in feeds if feed.is_picture]
        self.refused_commands = 0
        self._tap: Tap | None = None

    @classmethod
    def of_universe(
        cls,
        world: BulletWorld,
        context: Context,
        *,
        clock_hz: float = CLOCK_HZ,
        outlet: Outlet | None = None,
        node: Any = None,
    ) -> WorldNode:
        """Returns the node of a world, with the topics and true poses that its universe says."""
        places = world.universe.robots
        return cls(
            world,
            context,
            topics={place.id: place.topics for place in places},
            true_poses={place.id for place in places if place.ground_truth},
            clock_hz=clock_hz,
            outlet=outlet,
            node=node,
        )

    def poll(self) -> None:
        """Reads the commands that arrived, and applies the last one of each robot."""
        self.refused_commands += sum(not robot.poll(self._world.time_s) for robot in self._robots)

    def awaits_publisher(self, now_s: float) -> bool:
        """Returns whether the world waits for the first command of a robot, at a real time."""
        return any(robot.commands.awaits_publisher(now_s) for robot in self._robots)

    def publish(self, sensors: Sensors) -> None:
        """Publishes the messages that are due. Topics without subscribers are neither measured nor drawn."""
        now_s = self._world.time_s
        if self._clock_due(now_s):
            self.publish_clock()
        self._feeds.publish(sensors, now_s, self._tap)
        if self._outlet is not None:
            self._outlet.flush()

    def tap(self, tap: Tap, *, samples: bool = False) -> None:
        """Gives each message of the robots' topics to a function, with the topic and the time.

        With `samples`, topics without subscribers are measured for it at their lower rates.
        """
        self._tap = tap
        if samples:
            self._feeds.sample()
        for robot in self._robots:
            robot.commands.tap = tap
        if self._static is not None:
            tap("/tf_static", self._static, self._world.time_s)

    def change_messages(self, faults: TopicFaults) -> None:
        """Passes the messages of sensors and commands through faults from now on."""
        self._feeds.faults = faults
        for robot in self._robots:
            robot.commands.faults = faults

    def publish_clock(self) -> None:
        """Publishes the simulated time, also while it is paused."""
        self._clock.publish(messages.clock(self._world.time_s))

    def restart(self) -> None:
        """Resets all timers: simulated time starts again."""
        self._clock_due.restart()
        self._feeds.restart()

    def slow_cameras(self, share: float) -> None:
        """Reduces cameras to a share of their rates, 0 to 1."""
        self._feeds.slow_cameras(share)

    def wants_pictures(self) -> bool:
        """Returns whether a camera's images have subscribers."""
        return any(feed.has_receiver for feed in self._pictures)

    def take_notes(self) -> list[str]:
        """Returns the notes for users about received commands since the last call."""
        notes = [note for robot in self._robots for note in robot.commands.notes]
        for robot in self._robots:
            robot.commands.notes.clear()
        return notes

    @property
    def topics(self) -> set[str]:
        """The names of the topics whose messages a tap gets."""
        return self._feeds.topics | {robot.commands.topic for robot in self._robots} | {"/tf", "/tf_static"}

    def types_of(self, topic: str) -> tuple[type, ...]:
        """Returns the types that a robot accepts on a command topic; empty for any other topic."""
        return next((robot.commands.types for robot in self._robots if robot.commands.topic == topic), ())

    def node_for(self, topic: str, message_type: type) -> Node:
        """Returns the node that can use a topic with this type.

        A participant supports one type for a topic.
        """
        types = self.types_of(topic)
        return self._second_node() if message_type in types and message_type is not types[0] else self.node

    def make_way(self, topic: str, message_type: type) -> None:
        """Changes the type of a robot's command subscription, for a node of this participant."""
        for robot in self._robots:
            if robot.commands.topic == topic:
                robot.commands.make_way(message_type)

    def close(self) -> None:
        """Leaves the graph."""
        if self._outlet is not None:
            self._outlet.close()
        self.node.destroy_node()
        if self._second is not None:
            self._second.destroy_node()
            self._second.context.try_shutdown()

    def _second_node(self) -> Node:
        """Returns a node in another participant; creates it at the first call."""
        if self._second is None:
            context = Context()
            rclpy.init(context=context, domain_id=self.node.context.get_domain_id())
            self._second = Node(
                "world_stamped", context=context, start_parameter_services=False, enable_rosout=False
            )
        return self._second

    def _finder(self, index: int) -> Callable[[], Robot]:
        return lambda: self._world.robots[index]

    def _publisher(self, kind: Any, topic: str, qos: QoSProfile) -> Any:
        publisher = self.node.create_publisher(kind, topic, qos)
        return publisher if self._outlet is None else Piped(publisher, self._outlet)

    def _make_tf(self) -> Feed:
        from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - built at set-up, may be missing

        self._tf_static = self._publisher(TFMessage, "/tf_static", LATCHED_QOS)
        fixed = [transform for robot in self._robots for transform in robot.fixed_transforms()]
        self._static = messages.transforms(fixed)
        self._tf_static.publish(self._static)
        publisher = self._publisher(TFMessage, "/tf", _TF_QOS)
        return Feed(
            [publisher],
            lambda _, now_s: messages.transforms(
                [messages.transform(*row, now_s) for row in self._moving_transforms()]
            ),
            ODOMETRY_HZ,
            unheard_hz=SHOWN_HZ,
            encode=lambda now_s: Coded(TF_TYPE, encode_transforms(self._moving_transforms(), now_s)),
        )

    def _moving_transforms(self) -> list[Row]:
        return [row for robot in self._robots for row in robot.moving_transforms()]
