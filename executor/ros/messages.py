"""Builds ROS messages from what the world measures."""

from __future__ import annotations

import array
import math
from typing import TYPE_CHECKING, Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import Odometry as OdometryMessage
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from executor.robots.config import Camera, Lidar
    from executor.world.drive import Odometry
    from executor.world.interface import LidarReading
    from executor.world.transforms import Pose

ODOM_FRAME = "odom"
BASE_FRAME = "base_link"


def to_time(time_s: float) -> Time:
    """Returns simulated seconds as a stamp."""
    nanoseconds = round(time_s * 1e9)
    return Time(sec=nanoseconds // 1_000_000_000, nanosec=nanoseconds % 1_000_000_000)


def clock(time_s: float) -> Clock:
    """Returns the message of `/clock`."""
    return Clock(clock=to_time(time_s))


def laser_scan(lidar: Lidar, reading: LidarReading) -> LaserScan:
    """Returns a scan; its first ray looks straight ahead, the others follow counter-clockwise."""
    message = LaserScan()
    message.header.stamp = to_time(reading.time_s)
    message.header.frame_id = lidar.link
    message.angle_min = 0.0
    message.angle_increment = 2 * math.pi / lidar.rays
    message.angle_max = message.angle_increment * (lidar.rays - 1)
    message.scan_time = 1.0 / lidar.rate_hz
    message.range_min = lidar.range_min
    message.range_max = lidar.range_max
    message.ranges = array.array("f", reading.ranges.tobytes())
    return message


def image(camera: Camera, pixels: NDArray[np.uint8], time_s: float) -> Image:
    """Returns a picture as rgb8."""
    message = Image()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = optical_frame(camera)
    message.height, message.width = int(pixels.shape[0]), int(pixels.shape[1])
    message.encoding = "rgb8"
    message.step = message.width * 3
    # An array of the right type is taken over as it is; bytes or a list are copied one by one.
    message.data = array.array("B", pixels.tobytes())
    return message


def camera_info(camera: Camera, time_s: float) -> CameraInfo:
    """Returns the lens: a pinhole without distortion."""
    focal = camera.width / 2 / math.tan(camera.fov / 2)
    cx, cy = camera.width / 2, camera.height / 2
    message = CameraInfo()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = optical_frame(camera)
    message.width, message.height = camera.width, camera.height
    message.distortion_model = "plumb_bob"
    message.d = [0.0] * 5
    message.k = [focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0]
    message.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    message.p = [focal, 0.0, cx, 0.0, 0.0, focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    return message


def odometry(state: Odometry, time_s: float) -> OdometryMessage:
    """Returns where the wheels say that the robot is."""
    message = OdometryMessage()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = ODOM_FRAME
    message.child_frame_id = BASE_FRAME
    message.pose.pose.position.x = state.x
    message.pose.pose.position.y = state.y
    message.pose.pose.orientation = _heading(state.yaw)
    message.twist.twist.linear.x = state.linear
    message.twist.twist.angular.z = state.angular
    return message


def odometry_transform(state: Odometry, time_s: float) -> TransformStamped:
    """Returns the transform from the odometry's frame to the robot."""
    message = TransformStamped()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = ODOM_FRAME
    message.child_frame_id = BASE_FRAME
    message.transform.translation.x = state.x
    message.transform.translation.y = state.y
    message.transform.rotation = _heading(state.yaw)
    return message


def fixed_transform(parent: str, child: str, pose: Pose) -> TransformStamped:
    """Returns where a part of a robot sits."""
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id = parent, child
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = pose[:3]
    rotation.x, rotation.y, rotation.z, rotation.w = pose[3:]
    return message


def joint_state(states: Mapping[str, tuple[float, float]], time_s: float) -> JointState:
    """Returns angles and rates of the wheels."""
    message = JointState()
    message.header.stamp = to_time(time_s)
    message.name = list(states)
    message.position = [state[0] for state in states.values()]
    message.velocity = [state[1] for state in states.values()]
    return message


def optical_frame(camera: Camera) -> str:
    """Names the frame of a camera whose z looks ahead, as REP-103 asks of pictures."""
    return camera.link.removesuffix("_link") + "_optical_frame"


def _heading(yaw: float) -> Quaternion:
    return Quaternion(x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2))


def transforms(messages: list[TransformStamped]) -> Any:
    """Returns the message of `/tf`; only where `tf2_msgs` is there."""
    from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - built at set-up, may be missing

    return TFMessage(transforms=messages)
