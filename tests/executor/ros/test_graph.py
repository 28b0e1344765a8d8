"""Another process with plain rclpy sees each topic with its declared type, QoS, frame and rate."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest

from executor.ros.environment import has_tf, ros_environment
from executor.supervision.channel import Channel, socket_pair
from tests.domains import own_domain_id
from tests.executor.ros.test_delivery import wait_for

ROOT = Path(__file__).parents[3]
DOMAIN_ID = own_domain_id()
HEARD_S = 3.0  # of simulated time

# topic: type, reliable, frame, rate; pictures are left out, since test_delivery counts them
TOPICS: dict[str, tuple[str, str | None, float]] = {
    "/clock": ("rosgraph_msgs/msg/Clock", None, 60),
    "/odom": ("nav_msgs/msg/Odometry", "odom", 30),
    "/joint_states": ("sensor_msgs/msg/JointState", "", 30),
    "/scan": ("sensor_msgs/msg/LaserScan", "laser_link", 10),
    "/imu": ("sensor_msgs/msg/Imu", "imu_link", 30),
    "/bumper": ("std_msgs/msg/Bool", None, 20),
    "/bumper/left": ("std_msgs/msg/Bool", None, 20),
    "/battery_state": ("sensor_msgs/msg/BatteryState", "", 1),
    "/camera/camera_info": ("sensor_msgs/msg/CameraInfo", "camera_optical_frame", 15),
    "/depth_camera/depth/camera_info": ("sensor_msgs/msg/CameraInfo", "camera_optical_frame", 15),
    "/depth_camera/depth/image_raw": ("sensor_msgs/msg/Image", "camera_optical_frame", 15),
    "/helper/odom": ("nav_msgs/msg/Odometry", "helper/odom", 30),
    "/helper/scan": ("sensor_msgs/msg/LaserScan", "helper/laser_link", 5),
    **({"/tf": ("tf2_msgs/msg/TFMessage", "odom", 30)} if has_tf() else {}),
}
UNIVERSE = """\
format: bt-studio/universe
version: 1
name: two robots
models: [{id: wall, shape: box, size: [0.2, 4, 1], pose: [2, 0, 0.5, 0, 0, 0]}]
robots:
  - {id: robot, model: turtle2}
  - {id: helper, model: burger, pose: [0, 1, 0, 0, 0, 0]}
"""


def least_camera_share(channel: Channel[Any, Any]) -> float:
    """Returns the smallest share of their rates at which cameras drew: they slow down first."""
    shares = [1.0]
    while message := channel.receive(0):
        if message["type"] == "sim":
            shares.append(message["camera_share"])
    return min(shares)


@pytest.fixture(scope="module")
def heard() -> Iterator[dict[str, Any]]:
    """Returns the messages that a listener in another process received from a world in a third one."""
    environment = {**os.environ, **ros_environment(DOMAIN_ID), "PYTHONPATH": str(ROOT)}
    ours, theirs = socket_pair()
    world = subprocess.Popen(
        [sys.executable, "-m", "executor.world.process", "--channel-fd", str(theirs.fileno())],
        pass_fds=[theirs.fileno()],
        env=environment,
    )
    theirs.close()
    channel: Channel[Any, Any] = Channel(ours.detach(), msgspec.msgpack.decode)
    script = str(Path(__file__).with_name("graph_listener.py"))
    listener = subprocess.Popen(
        [sys.executable, script, str(HEARD_S), ",".join(TOPICS)],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert listener.stdout is not None
        start = {"type": "start", "universe": UNIVERSE, "seed": 1, "speed": 0.4, "domain_id": DOMAIN_ID}
        channel.send(start)
        wait_for(channel, "ready")
        assert json.loads(listener.stdout.readline()) == {"ready": True}
        channel.send({"type": "resume"})
        found = json.loads(listener.stdout.readline())
        yield found | {"camera_share": least_camera_share(channel)}
    finally:
        channel.send({"type": "stop"})
        listener.communicate(timeout=30)
        world.wait(30)
        channel.close()


@pytest.mark.simulation
@pytest.mark.parametrize("topic", TOPICS)
def test_a_topic_is_as_declared(heard: dict[str, Any], topic: str) -> None:
    kind, frame, rate = TOPICS[topic]
    assert heard["seen"][topic] == {"type": kind, "reliable": True}  # it matches both kinds of subscribers
    if frame is not None:
        assert heard["frames"][topic] == frame
    stamps, heard_s = heard["stamps"][topic], HEARD_S
    if topic == "/clock":
        stamps = [stamp for stamp in stamps if stamp > 0]  # it is 0 while the world is paused
        heard_s = stamps[-1]  # a busy listener stops before it has read the last ones
        assert heard_s > HEARD_S - 1
    least = rate * heard["camera_share"] if "camera" in topic else rate
    assert len(stamps) >= least * heard_s - 1
    assert len(stamps) <= rate * heard_s + 2
    assert stamps == sorted(stamps)
