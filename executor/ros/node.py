"""A world's ROS node: takes `/cmd_vel`, publishes sensors, odometry and time. It needs no executor.

Everything is pulled: `poll` takes what arrived, `publish` sends what is due. So the world's loop has one
thread and an order of its own, and the same node serves real time and lock-step.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan

from executor.ros import messages
from executor.ros.environment import has_tf

if TYPE_CHECKING:
    from rclpy.context import Context

    from executor.robots.config import Camera, Lidar
    from executor.world.interface import Robot, World
    from executor.world.sensors import Sensors

CLOCK_HZ: Final = 60.0
ODOMETRY_HZ: Final = 30.0
_CLOCK_QOS: Final = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
_LATCHED_QOS: Final = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_CAMERA_QOS: Final = qos_profile_sensor_data


class Due:
    """Tells when something of a given rate is to be done again, counted from the simulated time 0."""

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._done = -1

    def __call__(self, time_s: float) -> bool:
        """Tells whether it is due, and counts it as done."""
        turn = int(time_s * self._rate_hz + 1e-6)
        if turn == self._done:
            return False
        self._done = turn
        return True


@dataclass
class _LidarTopic:
    lidar: Lidar
    publisher: Any
    due: Due


@dataclass
class _CameraTopic:
    camera: Camera
    pictures: list[Any]
    infos: list[Any]
    due: Due


@dataclass
class _RobotTopics:
    robot_index: int
    commands: Any
    odometry: Any
    joints: Any
    lidars: list[_LidarTopic] = field(default_factory=list)
    cameras: list[_CameraTopic] = field(default_factory=list)


class WorldNode:
    """The topics of a world. A second robot's stand under its id, the first one's at the root."""

    def __init__(
        self,
        world: World,
        context: Context,
        *,
        topics: dict[str, dict[str, str]] | None = None,
        clock_hz: float = CLOCK_HZ,
    ) -> None:
        self._world = world
        self.node = Node(
            "world",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
        )
        self._clock = self.node.create_publisher(Clock, "/clock", _CLOCK_QOS)
        self._clock_hz = clock_hz
        self._clock_due, self._odometry_due = Due(clock_hz), Due(ODOMETRY_HZ)
        renamed = topics or {}
        self._robots = [
            self._make_topics(i, robot, renamed.get(robot.id, {})) for i, robot in enumerate(world.robots)
        ]
        self._tf = self._make_tf() if has_tf() else None
        self.refused_commands = 0

    def poll(self) -> None:
        """Takes the commands that arrived; the last one of each robot counts."""
        for topics in self._robots:
            twist = None
            while (taken := take(topics.commands)) is not None:
                twist = taken
            if twist is not None and not self._world.robots[topics.robot_index].command(
                twist.linear.x, twist.angular.z
            ):
                self.refused_commands += 1

    def publish(self, sensors: Sensors) -> None:
        """Sends what is due now. Nothing is measured or drawn that nobody receives."""
        now_s = self._world.time_s
        if self._clock_due(now_s):
            self.publish_clock()
        odometry_due = self._odometry_due(now_s)
        for topics in self._robots:
            robot = self._world.robots[topics.robot_index]
            if odometry_due:
                self._publish_motion(topics, robot, now_s)
            for lidar in topics.lidars:
                if lidar.due(now_s) and lidar.publisher.get_subscription_count():
                    reading = sensors.scan(robot, lidar.lidar)
                    lidar.publisher.publish(messages.laser_scan(lidar.lidar, reading))
            for camera in topics.cameras:
                if camera.due(now_s):
                    self._publish_picture(camera, robot, now_s, sensors)

    def publish_clock(self) -> None:
        """Sends the simulated time, also while it stands still."""
        self._clock.publish(messages.clock(self._world.time_s))

    def restart(self) -> None:
        """Forgets what was done when: simulated time begins anew."""
        self._clock_due, self._odometry_due = Due(self._clock_hz), Due(ODOMETRY_HZ)
        for topics in self._robots:
            for sensor in topics.lidars:
                sensor.due = Due(sensor.lidar.rate_hz)
            for camera in topics.cameras:
                camera.due = Due(camera.camera.rate_hz)

    def wants_pictures(self) -> bool:
        """Tells whether anybody receives a camera's pictures."""
        return any(_has_receiver(camera.pictures) for topics in self._robots for camera in topics.cameras)

    def close(self) -> None:
        """Leaves the graph."""
        self.node.destroy_node()

    def _make_topics(self, index: int, robot: Robot, renamed: dict[str, str]) -> _RobotTopics:
        prefix = "" if index == 0 else f"/{robot.id}"
        node = self.node
        topics = _RobotTopics(
            robot_index=index,
            commands=node.create_subscription(Twist, f"{prefix}/cmd_vel", _ignore, 10),
            odometry=node.create_publisher(OdometryMessage, f"{prefix}/odom", 10),
            joints=node.create_publisher(JointState, f"{prefix}/joint_states", 10),
        )
        for lidar in robot.config.lidars:
            name = prefix + renamed.get(lidar.name, lidar.topic)
            publisher = node.create_publisher(LaserScan, name, qos_profile_sensor_data)
            topics.lidars.append(_LidarTopic(lidar, publisher, Due(lidar.rate_hz)))
        for camera in robot.config.cameras:
            names = [renamed.get(camera.name, camera.topic), *camera.aliases]
            pictures = [
                node.create_publisher(Image, prefix + name, _CAMERA_QOS) for name in dict.fromkeys(names)
            ]
            infos = [node.create_publisher(CameraInfo, prefix + camera.info_topic, _CAMERA_QOS)]
            topics.cameras.append(_CameraTopic(camera, pictures, infos, Due(camera.rate_hz)))
        return topics

    def _make_tf(self) -> Any:
        from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - built at set-up, may be missing

        static = self.node.create_publisher(TFMessage, "/tf_static", _LATCHED_QOS)
        fixed = [
            messages.fixed_transform(joint.parent, joint.child, joint.origin)
            for robot in self._world.robots[:1]
            for joint in robot.config.urdf.joints.values()
            if joint.kind == "fixed"
        ]
        optical = (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5)
        fixed += [
            messages.fixed_transform(camera.link, messages.optical_frame(camera), optical)
            for robot in self._world.robots[:1]
            for camera in robot.config.cameras
        ]
        static.publish(messages.transforms(fixed))
        self._tf_static = static
        return self.node.create_publisher(TFMessage, "/tf", 100)

    def _publish_motion(self, topics: _RobotTopics, robot: Robot, now_s: float) -> None:
        if topics.odometry.get_subscription_count():
            topics.odometry.publish(messages.odometry(robot.odometry, now_s))
        if topics.joints.get_subscription_count():
            topics.joints.publish(messages.joint_state(robot.joint_states(), now_s))
        if self._tf is not None and topics.robot_index == 0 and self._tf.get_subscription_count():
            transform = messages.odometry_transform(robot.odometry, now_s)
            self._tf.publish(messages.transforms([transform]))

    def _publish_picture(self, topic: _CameraTopic, robot: Robot, now_s: float, sensors: Sensors) -> None:
        for publisher in topic.infos:
            if publisher.get_subscription_count():
                publisher.publish(messages.camera_info(topic.camera, now_s))
        if not _has_receiver(topic.pictures):
            return
        message = messages.image(topic.camera, sensors.picture(robot, topic.camera), now_s)
        for publisher in topic.pictures:
            if publisher.get_subscription_count():
                publisher.publish(message)


def take(subscription: Any) -> Any:
    """Takes one message of a subscription without an executor; None if there is none."""
    with subscription.handle:
        taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    return None if taken is None else taken[0]


def _has_receiver(publishers: list[Any]) -> bool:
    return any(publisher.get_subscription_count() for publisher in publishers)


def _ignore(message: object) -> None:
    """Never called: messages are taken, no executor spins this node."""
