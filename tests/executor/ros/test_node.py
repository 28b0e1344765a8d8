"""The world's topics, received by another node of this process: types, rates, frames, QoS, values."""

import math
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import Twist
from msgspec import to_builtins
from nav_msgs.msg import Odometry
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import ReliabilityPolicy, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan
from std_msgs.msg import Float64

from executor.render import make_renderer
from executor.ros.environment import has_tf
from executor.ros.node import Due, WorldNode, take
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from executor.world.sensing.sensors import Sensors
from executor.world.simulation.adaptation import FIRST_PATIENCE
from executor.world.simulation.loop import SLOW_CAMERAS, SimulationLoop


class Rig:
    """A world on ROS, and a listener."""

    def __init__(self, context: Context, robot: str | None = None) -> None:
        self.world = BulletWorld(load_builtin("walled_room"), robot=robot)
        self.drawn = 0
        self.sensors = Sensors(self.world, self._renderer)
        self.node = WorldNode(self.world, context)
        self.listener = Node("listener", context=context)
        self.ears: dict[str, Any] = {}

    def _renderer(self) -> Any:
        self.drawn += 1
        return make_renderer()

    def listen(self, kind: Any, topic: str) -> None:
        self.ears[topic] = self.listener.create_subscription(kind, topic, print, qos_profile_sensor_data)

    def run(self, seconds: float) -> dict[str, list[Any]]:
        heard: dict[str, list[Any]] = {topic: [] for topic in self.ears}
        for i in range(round(seconds * 60) + 1):
            self.node.poll()
            self.node.publish(self.sensors)
            for topic, ear in self.ears.items():
                while (message := take(ear)) is not None:
                    heard[topic].append(message)
            if i < round(seconds * 60):
                self.world.step(4)
                self.sensors.changed()
        return heard

    def close(self) -> None:
        self.node.close()
        self.listener.destroy_node()
        self.sensors.close()
        self.world.close()


@pytest.fixture
def rig(context: Context) -> Iterator[Rig]:
    made = Rig(context)
    yield made
    made.close()


def test_rates_types_and_frames(rig: Rig) -> None:
    topics = {
        "/scan": (LaserScan, 10, "laser_link"),
        "/odom": (Odometry, 30, "odom"),
        "/camera/camera_info": (CameraInfo, 15, "camera_optical_frame"),
        "/camera/image_raw": (Image, 15, "camera_optical_frame"),
        "/depth_camera/image_raw": (Image, 15, "camera_optical_frame"),
        "/joint_states": (JointState, 30, ""),
        "/clock": (Clock, 60, None),
    }
    for topic, (kind, _, _) in topics.items():
        rig.listen(kind, topic)
    heard = rig.run(1.0)
    for topic, (_, rate, frame) in topics.items():
        assert len(heard[topic]) == rate + 1, topic  # at 0 s and at 1 s
        if frame is not None:
            assert {message.header.frame_id for message in heard[topic]} == {frame}
    stamps = [m.clock.sec + m.clock.nanosec * 1e-9 for m in heard["/clock"]]
    assert stamps == pytest.approx([i / 60 for i in range(61)])


def test_an_image_matches_its_description(rig: Rig) -> None:
    rig.listen(Image, "/camera/image_raw")
    picture = rig.run(0.0)["/camera/image_raw"][0]
    assert (picture.width, picture.height, picture.encoding, picture.step) == (640, 480, "rgb8", 1920)
    assert len(picture.data) == 640 * 480 * 3
    assert np.frombuffer(picture.data, np.uint8).std() > 10


def test_without_subscribers_nothing_is_drawn(rig: Rig) -> None:
    rig.run(0.5)
    assert rig.drawn == 0
    assert not rig.node.wants_pictures()


def test_cameras_yield_where_the_machine_is_late_and_come_back(rig: Rig) -> None:
    said: list[dict[str, Any]] = []
    loop = SimulationLoop(rig.world, rig.sensors, rig.node, lambda message: said.append(to_builtins(message)))
    loop.resume()
    rig.listen(CameraInfo, "/camera/camera_info")
    rig.listen(Image, "/camera/image_raw")
    now_s = 100.0

    def pass_time(seconds: float, period_s: float) -> None:
        nonlocal now_s
        for _ in range(round(seconds / period_s)):
            now_s += period_s
            loop.run_due(now_s)
            for ear in rig.ears.values():
                while take(ear) is not None:
                    pass

    pass_time(2.25, 0.25)  # of each quarter of a second only a tenth is caught up
    assert [message["text"] for message in said if message["type"] == "log"] == [SLOW_CAMERAS]
    assert said[-1]["camera_share"] < 1
    pass_time(FIRST_PATIENCE + 2, 0.05)
    levels = [message["level"] for message in said if message["type"] == "log"]
    assert levels == ["warning", "info"]
    assert said[-1]["camera_share"] == 1.0


def test_the_lens_is_right(rig: Rig) -> None:
    rig.listen(CameraInfo, "/camera/camera_info")
    info = rig.run(0.0)["/camera/camera_info"][0]
    focal = 320 / math.tan(1.047 / 2)
    assert list(info.k) == pytest.approx([focal, 0, 320, 0, focal, 240, 0, 0, 1])
    assert info.distortion_model == "plumb_bob"


def test_a_scan_starts_ahead_and_turns_left(rig: Rig) -> None:
    rig.listen(LaserScan, "/scan")
    scan = rig.run(0.0)["/scan"][0]
    assert scan.angle_min == 0
    assert scan.angle_increment == pytest.approx(math.radians(1))
    assert len(scan.ranges) == 360
    assert scan.angle_max == pytest.approx(math.radians(359))
    assert scan.scan_time == pytest.approx(0.1)
    assert scan.range_min < min(scan.ranges)


def test_commands_drive_and_odometry_follows(rig: Rig) -> None:
    rig.listen(Odometry, "/odom")
    publisher = rig.listener.create_publisher(Twist, "/cmd_vel", 10)
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.4, 0.2
    for _ in range(5):
        publisher.publish(twist)
        heard = rig.run(0.4)["/odom"]
    last = heard[-1]
    assert last.child_frame_id == "base_footprint"
    assert last.twist.twist.linear.x == pytest.approx(0.4, abs=0.01)
    assert last.twist.twist.angular.z == pytest.approx(0.2, abs=0.01)
    x, y, _ = rig.world.robots[0].pose
    assert (last.pose.pose.position.x, last.pose.pose.position.y) == pytest.approx((x, y), abs=0.02)


def test_a_command_that_is_no_number_is_counted_not_obeyed(rig: Rig) -> None:
    publisher = rig.listener.create_publisher(Twist, "/cmd_vel", 10)
    twist = Twist()
    twist.linear.x = math.nan
    publisher.publish(twist)
    rig.run(0.2)
    assert rig.node.refused_commands == 1
    assert rig.world.robots[0].distance_m < 1e-3


def test_all_publishers_are_reliable(rig: Rig) -> None:
    for topic in (
        "/clock",
        "/scan",
        "/camera/image_raw",
        "/camera/camera_info",
        "/depth_camera/image_raw",
        "/odom",
    ):
        [info] = rig.listener.get_publishers_info_by_topic(topic)
        assert info.qos_profile.reliability == ReliabilityPolicy.RELIABLE


def test_tf_is_published_where_its_messages_are_installed(rig: Rig) -> None:
    names = dict(rig.listener.get_topic_names_and_types())
    assert ("/tf" in names) == ("/tf_static" in names) == has_tf()
    if has_tf():
        from tf2_msgs.msg import TFMessage

        rig.listen(TFMessage, "/tf")
        transform = rig.run(0.2)["/tf"][-1].transforms[0]
        assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base_footprint")


def test_a_joint_moves_to_its_target_and_tf_follows(context: Context) -> None:
    rig = Rig(context, "lookout")
    rig.listen(JointState, "/joint_states")
    if has_tf():
        from tf2_msgs.msg import TFMessage

        rig.listen(TFMessage, "/tf")
    publisher = rig.listener.create_publisher(Float64, "/camera/pan/command", 10)
    end_s = time.monotonic() + 30
    while not publisher.get_subscription_count():
        assert time.monotonic() < end_s, "the world does not listen"
        time.sleep(0.01)
    publisher.publish(Float64(data=0.7))
    publisher.publish(Float64(data=math.nan))
    heard = rig.run(0.2)
    assert rig.node.refused_commands == 1
    publisher.publish(Float64(data=0.7))
    heard = rig.run(1.0)
    state = heard["/joint_states"][-1]
    assert dict(zip(state.name, state.position, strict=True))["pan_joint"] == pytest.approx(0.7, abs=0.005)
    if has_tf():
        frames = {t.child_frame_id: t for t in heard["/tf"][-1].transforms}
        assert frames["pan_link"].header.frame_id == "base_link"
        turn = frames["pan_link"].transform.rotation
        assert 2 * math.atan2(turn.z, turn.w) == pytest.approx(0.7, abs=0.005)
    rig.close()


def test_a_restart_publishes_from_zero(rig: Rig) -> None:
    rig.listen(Clock, "/clock")
    rig.run(0.5)
    rig.world.reset()
    rig.node.restart()
    assert len(rig.run(0.1)["/clock"]) == 7


@pytest.mark.parametrize("rate", [10.0, 15.0, 30.0, 24.0])
def test_due_keeps_its_rate_over_time(rate: float) -> None:
    due = Due(rate)
    assert sum(due(i / 240) for i in range(240 * 20)) == rate * 20


def test_of_universe_renames_topics_and_publishes_true_poses_as_the_universe_says(context: Context) -> None:
    universe = load_builtin("walled_room")
    place = universe.robots[0].model_copy(update={"ground_truth": True, "topics": {"scan": "/told_scan"}})
    world = BulletWorld(universe.model_copy(update={"robots": (place,)}))
    node = WorldNode.of_universe(world, context)
    try:
        names = {name for name, _ in node.node.get_publisher_names_and_types_by_node("world", "/")}
        assert {"/told_scan", "/ground_truth/odom"} <= names
        assert "/scan" not in names
    finally:
        node.close()
        world.close()
