"""Translates between the navigation's points and the messages of ROS."""

from __future__ import annotations

import array
import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import OccupancyGrid, Path

from executor.navigation.pursuit import wrapped
from executor.ros.messages import BASE_FRAME, LINK_FRAME, ODOM_FRAME, to_time

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.navigation.grid import Grid
    from executor.navigation.pursuit import Point, Pose

MAP_FRAME: Final = "map"
OCCUPIED: Final = 100


class FrameError(ValueError):
    """A pose is in a frame that is not known."""


def placed(pose: Pose, inner: Pose) -> Pose:
    """Returns where a pose in the frame of another pose is."""
    cosine, sine = math.cos(pose[2]), math.sin(pose[2])
    return (
        pose[0] + cosine * inner[0] - sine * inner[1],
        pose[1] + sine * inner[0] + cosine * inner[1],
        wrapped(pose[2] + inner[2]),
    )


def between(outer: Pose, inner: Pose) -> Pose:
    """Returns the pose of the odom frame in the map frame, from one pose of the robot in both."""
    yaw = wrapped(outer[2] - inner[2])
    x, y, _ = placed((0.0, 0.0, yaw), (inner[0], inner[1], 0.0))
    return outer[0] - x, outer[1] - y, yaw


def pose_of(message: Any, robot: Pose, odometry: Pose) -> Pose:
    """Returns a stamped pose in the map.

    Args:
        message: a PoseStamped; without a frame it is in the map.
        robot: the robot's pose in the map.
        odometry: the robot's pose in the frame of the odometry.

    Raises:
        FrameError: its frame is not known.
    """
    place, turn = message.pose.position, message.pose.orientation
    yaw = math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2))
    pose = (place.x, place.y, yaw)
    frame = message.header.frame_id.removeprefix("/")
    if frame in {"", MAP_FRAME}:
        return pose
    if frame == ODOM_FRAME:
        return placed(between(robot, odometry), pose)
    if frame in {BASE_FRAME, LINK_FRAME}:
        return placed(robot, pose)
    raise FrameError(f"the frame '{frame}' is not known; give the pose in map, odom or base_link")


def stamped(pose: Pose, now_s: float) -> PoseStamped:
    """Returns a pose in the map as a message."""
    message = PoseStamped()
    message.header.frame_id, message.header.stamp = MAP_FRAME, to_time(now_s)
    message.pose.position.x, message.pose.position.y = float(pose[0]), float(pose[1])
    message.pose.orientation.z, message.pose.orientation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
    return message


def path_message(points: Sequence[Point], yaw: float | None, now_s: float) -> Path:
    """Returns a path as a message: each pose looks to the next one, the last one has the heading `yaw`."""
    message = Path()
    message.header.frame_id, message.header.stamp = MAP_FRAME, to_time(now_s)
    heading = yaw or 0.0
    for index, (x, y) in enumerate(points):
        if index + 1 < len(points):
            heading = math.atan2(points[index + 1][1] - y, points[index + 1][0] - x)
        elif yaw is not None:
            heading = yaw
        message.poses.append(stamped((x, y, heading), now_s))
    return message


def grid_message(grid: Grid, now_s: float) -> OccupancyGrid:
    """Returns a map as a message: free cells are 0, occupied ones 100."""
    message = OccupancyGrid()
    message.header.frame_id, message.header.stamp = MAP_FRAME, to_time(now_s)
    about = message.info
    about.map_load_time, about.resolution = message.header.stamp, float(grid.resolution)
    about.height, about.width = map(int, grid.occupied.shape)
    about.origin.position.x, about.origin.position.y = map(float, grid.origin)
    about.origin.orientation.w = 1.0
    cells = np.where(grid.occupied, OCCUPIED, 0).astype(np.int8)
    message.data = array.array("b", cells.tobytes())
    return message


def duration(seconds: float) -> Duration:
    """Returns seconds as a message."""
    whole = math.floor(seconds)
    return Duration(sec=whole, nanosec=min(round((seconds - whole) * 1e9), 999_999_999))


def seconds_of(message: Any) -> float:
    """Returns a duration in seconds."""
    return float(message.sec + message.nanosec * 1e-9)
