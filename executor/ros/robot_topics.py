"""The topics of one robot. Names and frames have the robot's id as prefix, except for the first robot."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from nav_msgs.msg import Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import BatteryState, CameraInfo, Image, Imu, JointState, LaserScan
from std_msgs.msg import Bool, Float64, String

from executor.ros import base_frames, messages
from executor.ros.commands import Commands
from executor.ros.feed import SHOWN_HZ, UNHEARD_HZ, Feed
from executor.ros.outlet import Outlet, Piped
from executor.ros.raw_take import ignore, take
from executor.world.geometry.kinematics import joint_pose
from executor.world.sensing.bumper import ZONES

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

    from executor.robots import sensors as config
    from executor.ros.transform_rows import Row
    from executor.world.interface import Robot
    from executor.world.sensing.bumper import Zone
    from executor.world.sensing.sensors import Sensors

ODOMETRY_HZ: Final = 30.0
LATCHED_QOS: Final = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_OPTICAL: Final = (0.0, 0.0, 0.0, -0.5, 0.5, -0.5, 0.5)
_COMMANDS: Final = 10
SENSOR_QOS: Final = QoSProfile(depth=5)
"""Quality of service of sensors: reliable, which matches both kinds of subscribers.

A full queue drops the oldest message.
"""


class RobotTopics:
    """Reads the commands of one robot, and feeds its topics.

    Args:
        node: the node of the publishers.
        robot: returns the robot; a function, since a reset creates new robots.
        index: the number of the robot in the world; the names of robot 0 have no prefix.
        renamed: topics that the universe renames, by the name of the sensor.
        second: returns a node for messages of a second type on one topic.
        outlet: the outlet through which the feeds publish; with None, they use their publishers directly.
    """

    def __init__(  # noqa: PLR0913 - a robot, and what its names come from
        self,
        node: Node,
        robot: Callable[[], Robot],
        index: int,
        renamed: dict[str, str],
        second: Callable[[], Node],
        *,
        ground_truth: bool = False,
        outlet: Outlet | None = None,
    ) -> None:
        self._outlet = outlet
        self._node = node
        self._robot = robot
        self._renamed = renamed
        self._config = robot().config
        robot_id = robot().id
        self._prefix = "" if index == 0 else f"/{robot_id}"
        self._frames = "" if index == 0 else f"{robot_id}/"
        config = self._config
        self._base = base_frames.odometry_frame(config)
        self.commands = Commands(
            node, f"{self._prefix}/cmd_vel", config.command_type, config.drive.timeout_s, second
        )
        self._joints = {
            drive.joint: node.create_subscription(
                Float64, self._prefix + self._name(drive.joint, drive.topic), ignore, _COMMANDS
            )
            for drive in self._config.joints
        }
        self.feeds: list[Feed] = []
        self._add_motion()
        if ground_truth or config.ground_truth:
            self._add_ground_truth()
        for lidar in self._config.lidars:
            self._add_lidar(lidar)
        for camera in self._config.cameras:
            self._add_camera(camera)
        for imu in self._config.imus:
            self._add_imu(imu)
        for bumper in self._config.bumpers:
            self._add_bumper(bumper)
        for battery in self._config.batteries:
            self._add_battery(battery)
        self._describe()

    def poll(self, now_s: float) -> bool:
        """Reads the commands that arrived, and applies the last one of each topic.

        Returns whether all were valid.
        """
        robot = self._robot()
        command, obeyed = self.commands.take(now_s)
        if command is not None:
            obeyed = robot.command(*command)
        for joint, subscription in self._joints.items():
            wanted = _last(subscription)
            obeyed &= wanted is None or robot.command_joint(joint, wanted.data)
        return obeyed

    def moving_transforms(self) -> list[Row]:
        """Returns the transforms of the odometry frame and of moving links."""
        robot = self._robot()
        found = [messages.odometry_row(robot.odometry, self._frames, self._base)]
        for name, (position, _) in robot.joint_states().items():
            joint = self._config.urdf.joints[name]
            parent, child = self._frames + joint.parent, self._frames + joint.child
            found.append((parent, child, joint_pose(joint, position)))
        return found

    def fixed_transforms(self) -> list[Any]:
        """Returns the transforms of fixed links, including optical frames of cameras."""
        frames = self._frames
        fixed = [
            messages.transform(frames + joint.parent, frames + joint.child, joint.origin)
            for joint in self._config.urdf.joints.values()
            if joint.kind == "fixed"
        ]
        fixed += base_frames.fixed_transforms(self._config, frames)
        return fixed + [
            messages.transform(frames + camera.link, frames + messages.optical_frame(camera), _OPTICAL)
            for camera in self._config.cameras
        ]

    def _publisher(self, kind: Any, topic: str, qos: Any = SENSOR_QOS) -> Any:
        publisher = self._node.create_publisher(kind, self._prefix + topic, qos)
        return publisher if self._outlet is None else Piped(publisher, self._outlet)

    def _name(self, sensor: str, topic: str) -> str:
        return self._renamed.get(sensor, topic)

    def _feed(  # noqa: PLR0913 - a feed, and when it is measured
        self,
        publishers: list[Any],
        rate_hz: float,
        make: Callable[[Sensors, float], Any],
        *,
        is_picture: bool = False,
        of_camera: bool = False,
        unheard_hz: float = UNHEARD_HZ,
        jpeg: Callable[[Sensors], bytes] | None = None,
    ) -> None:
        of_camera = is_picture or of_camera
        self.feeds.append(Feed(publishers, make, rate_hz, is_picture, of_camera, unheard_hz, jpeg=jpeg))

    def _add_motion(self) -> None:
        frames, base = self._frames, self._base
        self._feed(
            [self._publisher(Odometry, "/odom")],
            ODOMETRY_HZ,
            lambda _, now_s: messages.odometry(self._robot().odometry, now_s, frames, base),
        )
        self._feed(
            [self._publisher(JointState, "/joint_states")],
            ODOMETRY_HZ,
            lambda _, now_s: messages.joint_state(self._robot().joint_states(), now_s),
        )

    def _add_ground_truth(self) -> None:
        self._feed(
            [self._publisher(Odometry, "/ground_truth/odom")],
            ODOMETRY_HZ,
            lambda _, now_s: base_frames.true_odometry(self._robot(), now_s, self._frames),
        )

    def _add_lidar(self, lidar: config.Lidar) -> None:
        name = self._name(lidar.name, lidar.topic)
        self._feed(
            [self._publisher(LaserScan, name)],
            lidar.rate_hz,
            lambda sensors, _: messages.laser_scan(lidar, sensors.scan(self._robot(), lidar), self._frames),
            unheard_hz=SHOWN_HZ,
        )

    def _add_camera(self, camera: config.Camera) -> None:
        names = dict.fromkeys([self._name(camera.name, camera.topic), *camera.aliases])
        frames = self._frames
        infos = [camera.info_topic]
        self._feed(
            [self._publisher(Image, name) for name in names],
            camera.rate_hz,
            lambda sensors, now_s: messages.image(
                camera, sensors.picture(self._robot(), camera), now_s, frames
            ),
            is_picture=True,
            jpeg=lambda sensors: sensors.jpeg(self._robot(), camera),
        )
        if camera.depth_topic is not None:
            self._feed(
                [self._publisher(Image, camera.depth_topic)],
                camera.rate_hz,
                lambda sensors, now_s: messages.depth_image(
                    camera, sensors.depth(self._robot(), camera), now_s, frames
                ),
                is_picture=True,
            )
            infos += [camera.depth_info_topic] if camera.depth_info_topic else []
        self._feed(
            [self._publisher(CameraInfo, name) for name in dict.fromkeys(infos)],
            camera.rate_hz,
            lambda _, now_s: messages.camera_info(camera, now_s, frames),
            of_camera=True,
        )

    def _add_imu(self, imu: config.Imu) -> None:
        self._feed(
            [self._publisher(Imu, self._name(imu.name, imu.topic))],
            imu.rate_hz,
            lambda _s, _t: messages.imu(imu, self._robot().imu(imu), self._frames),
        )

    def _add_bumper(self, bumper: config.Bumper) -> None:
        topic = self._name(bumper.name, bumper.topic)
        self._feed(
            [self._publisher(Bool, topic)],
            bumper.rate_hz,
            lambda _s, _t: Bool(data=bool(self._robot().pressed())),
        )
        for zone in ZONES:
            self._feed([self._publisher(Bool, f"{topic}/{zone}")], bumper.rate_hz, self._zone(zone))

    def _zone(self, zone: Zone) -> Callable[[Sensors, float], Bool]:
        return lambda _s, _t: Bool(data=zone in self._robot().pressed())

    def _add_battery(self, battery: config.Battery) -> None:
        self._feed(
            [self._publisher(BatteryState, self._name(battery.name, battery.topic))],
            battery.rate_hz,
            lambda _, now_s: messages.battery_state(self._robot().battery(battery), now_s),
        )

    def _describe(self) -> None:
        self._description = self._publisher(String, "/robot_description", LATCHED_QOS)
        self._description.publish(String(data=self._config.urdf.text))


def _last(subscription: Any) -> Any:
    last = None
    while (taken := take(subscription)) is not None:
        last = taken
    return last
