"""Builds ROS messages from measurements of the world."""

from __future__ import annotations

import array
import math
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from nav_msgs.msg import Odometry as OdometryMessage
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, CameraInfo, Image, JointState, LaserScan
from sensor_msgs.msg import Imu as ImuMessage
from std_msgs.msg import Header

from executor.world.geometry.transforms import from_xyz_rpy

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from executor.robots.config import Camera, Imu, Lidar
    from executor.ros.transform_rows import Row
    from executor.world.geometry.transforms import Pose
    from executor.world.interface import LidarReading
    from executor.world.physics.drive import Odometry
    from executor.world.sensing.battery import BatteryReading
    from executor.world.sensing.imu import ImuReading

ODOM_FRAME = "odom"
BASE_FRAME = "base_footprint"
LINK_FRAME = "base_link"
WORLD_FRAME = "world"
_LEAST_VARIANCE = 1e-6  # variance of exact values; filters must be able to invert it
_UNKNOWN = 1e6
_Message = TypeVar("_Message")


def to_time(time_s: float) -> Time:
    """Returns simulated seconds as a stamp."""
    sec, nanosec = divmod(round(time_s * 1e9), 1_000_000_000)
    return _made(Time, _sec=sec, _nanosec=nanosec)


def clock(time_s: float) -> Clock:
    """Returns the message of `/clock`."""
    return _made(Clock, _clock=to_time(time_s))


def laser_scan(lidar: Lidar, reading: LidarReading, prefix: str = "") -> LaserScan:
    """Returns a scan; its rays follow counter-clockwise from `angle_min`."""
    return _made(
        LaserScan,
        _header=_header(prefix + lidar.link, reading.time_s),
        _angle_min=lidar.angle_min,
        _angle_increment=lidar.angle_increment,
        _angle_max=lidar.angle_min + lidar.angle_increment * (lidar.rays - 1),
        _time_increment=0.0,
        _scan_time=1.0 / lidar.rate_hz,
        _range_min=lidar.range_min,
        _range_max=lidar.range_max,
        _ranges=array.array("f", reading.ranges.tobytes()),
        _intensities=array.array("f"),
    )


def image(camera: Camera, pixels: NDArray[np.uint8], time_s: float, prefix: str = "") -> Image:
    """Returns an image as rgb8."""
    message = Image()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = prefix + optical_frame(camera)
    message.height, message.width = int(pixels.shape[0]), int(pixels.shape[1])
    message.encoding = "rgb8"
    message.step = message.width * 3
    message.data = _data(pixels)
    return message


def depth_image(camera: Camera, metres: NDArray[np.float32], time_s: float, prefix: str = "") -> Image:
    """Returns a depth image as 32FC1; values are in m."""
    message = Image()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = prefix + optical_frame(camera)
    message.height, message.width = int(metres.shape[0]), int(metres.shape[1])
    message.encoding = "32FC1"
    message.step = message.width * 4
    message.data = _data(metres.astype("<f4", copy=False))
    return message


def camera_info(camera: Camera, time_s: float, prefix: str = "") -> CameraInfo:
    """Returns the camera model: a pinhole without distortion."""
    focal = camera.width / 2 / math.tan(camera.fov / 2)
    cx, cy = camera.width / 2, camera.height / 2
    message = CameraInfo()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = prefix + optical_frame(camera)
    message.width, message.height = camera.width, camera.height
    message.distortion_model = "plumb_bob"
    message.d = array.array("d", bytes(40))
    message.k = [focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0]
    message.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    message.p = [focal, 0.0, cx, 0.0, 0.0, focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    return message


def odometry(state: Odometry, time_s: float, prefix: str = "", frame: str = BASE_FRAME) -> OdometryMessage:
    """Returns the odometry message; the covariance of the pose grows with the distance."""
    message = OdometryMessage()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = prefix + ODOM_FRAME
    message.child_frame_id = prefix + frame
    message.pose.pose.position.x = state.x
    message.pose.pose.position.y = state.y
    message.pose.pose.orientation = _heading(state.yaw)
    message.twist.twist.linear.x = state.linear
    message.twist.twist.angular.z = state.angular
    xx, xy, xt, yy, yt, tt = state.covariance
    known = [each + _LEAST_VARIANCE for each in (xx, yy, tt)]
    matrix = _diagonal(known[0], known[1], _UNKNOWN, _UNKNOWN, _UNKNOWN, known[2])
    matrix[1] = matrix[6] = xy
    matrix[5] = matrix[30] = xt
    matrix[11] = matrix[31] = yt
    message.pose.covariance = matrix
    # The twist is measured well: only its integral drifts.
    least = _LEAST_VARIANCE
    message.twist.covariance = _diagonal(least, least, _UNKNOWN, _UNKNOWN, _UNKNOWN, least)
    return message


def ground_truth(
    pose: Pose, twist: tuple[float, float, float], time_s: float, prefix: str = "", frame: str = BASE_FRAME
) -> OdometryMessage:
    """Returns the odometry message of the true pose in the world and the true twist, without noise."""
    message = OdometryMessage()
    message.header.stamp = to_time(time_s)
    message.header.frame_id = WORLD_FRAME
    message.child_frame_id = prefix + frame
    place, turn = message.pose.pose.position, message.pose.pose.orientation
    place.x, place.y, place.z = map(float, pose[:3])
    turn.x, turn.y, turn.z, turn.w = map(float, pose[3:])
    message.twist.twist.linear.x, message.twist.twist.linear.y, message.twist.twist.angular.z = twist
    return message


def transform(parent: str, child: str, pose: Pose, time_s: float = 0.0) -> TransformStamped:
    """Returns the pose of the frame `child` in the frame `parent`, as a transform message."""
    x, y, z, qx, qy, qz, qw = map(float, pose)
    place = _made(Vector3, _x=x, _y=y, _z=z)
    turn = _made(Quaternion, _x=qx, _y=qy, _z=qz, _w=qw)
    return _made(
        TransformStamped,
        _header=_header(parent, time_s),
        _child_frame_id=child,
        _transform=_made(Transform, _translation=place, _rotation=turn),
    )


def odometry_row(state: Odometry, prefix: str = "", frame: str = BASE_FRAME) -> Row:
    """Returns the transform from the odometry's frame to the robot."""
    pose = from_xyz_rpy((state.x, state.y, 0.0, 0.0, 0.0, state.yaw))
    return prefix + ODOM_FRAME, prefix + frame, pose


def imu(sensor: Imu, reading: ImuReading, prefix: str = "") -> ImuMessage:
    """Returns the message of an inertial measurement unit."""
    message = ImuMessage()
    message.header.stamp = to_time(reading.time_s)
    message.header.frame_id = prefix + sensor.link
    x, y, z, w = reading.orientation
    message.orientation = Quaternion(x=x, y=y, z=z, w=w)
    rate, felt = message.angular_velocity, message.linear_acceleration
    rate.x, rate.y, rate.z = reading.rate
    felt.x, felt.y, felt.z = reading.acceleration
    message.orientation_covariance = [1e-6, 0.0, 0.0, 0.0, 1e-6, 0.0, 0.0, 0.0, 1e-6]
    rates, felts = max(sensor.rate_noise, 1e-4) ** 2, max(sensor.acceleration_noise, 1e-3) ** 2
    message.angular_velocity_covariance = [rates, 0.0, 0.0, 0.0, rates, 0.0, 0.0, 0.0, rates]
    message.linear_acceleration_covariance = [felts, 0.0, 0.0, 0.0, felts, 0.0, 0.0, 0.0, felts]
    return message


def battery_state(reading: BatteryReading, time_s: float) -> BatteryState:
    """Returns the charge of a battery."""
    message = BatteryState()
    message.header.stamp = to_time(time_s)
    message.voltage, message.current = reading.voltage, reading.current
    message.charge = reading.charge
    message.capacity = message.design_capacity = reading.capacity
    message.percentage = reading.percentage
    message.temperature = math.nan
    message.power_supply_status = BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
    message.power_supply_health = BatteryState.POWER_SUPPLY_HEALTH_GOOD
    message.power_supply_technology = BatteryState.POWER_SUPPLY_TECHNOLOGY_LION
    message.present = True
    return message


def joint_state(states: Mapping[str, tuple[float, float]], time_s: float) -> JointState:
    """Returns angles and rates of the wheels."""
    message = JointState()
    message.header.stamp = to_time(time_s)
    message.name = list(states)
    message.position = array.array("d", [state[0] for state in states.values()])
    message.velocity = array.array("d", [state[1] for state in states.values()])
    return message


def optical_frame(camera: Camera) -> str:
    """Returns the name of a camera's optical frame, with z ahead (REP-103)."""
    return camera.link.removesuffix("_link") + "_optical_frame"


def _data(pixels: NDArray[Any]) -> array.array[int]:
    """Returns the pixels as an array of the type that rclpy uses unchanged.

    rclpy copies `bytes` item by item.
    """
    data = array.array("B")
    data.frombytes(np.ascontiguousarray(pixels).reshape(-1).view(np.uint8).data)  # its bytes, copied once
    return data


def _diagonal(*values: float) -> NDArray[np.float64]:
    matrix = np.zeros(36)
    matrix[::7] = values
    return matrix


def _heading(yaw: float) -> Quaternion:
    return _made(Quaternion, _x=0.0, _y=0.0, _z=math.sin(yaw / 2), _w=math.cos(yaw / 2))


def _header(frame_id: str, time_s: float) -> Header:
    return _made(Header, _stamp=to_time(time_s), _frame_id=frame_id)


def _made(kind: type[_Message], **slots: Any) -> _Message:
    """Returns a message with all its slots, without its constructor, which makes and checks each field twice.

    The checks are for users' code, which runs in the same process in lock-step.
    """
    message = kind.__new__(kind)
    message._check_fields = False  # type: ignore[attr-defined]
    for name, value in slots.items():
        setattr(message, name, value)
    return message


def transforms(messages: list[TransformStamped]) -> Any:
    """Returns the message of `/tf`. Requires `tf2_msgs`."""
    from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - built at set-up, may be missing

    return TFMessage(transforms=messages)
