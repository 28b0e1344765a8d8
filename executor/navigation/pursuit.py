"""Regulated pure pursuit: the velocity that follows a path.

The robot drives along the arc to a point ahead on the path, slower in curves, near obstacles and near the
end. It turns on the spot where the path leads sideways or back. (Macenski et al., "Regulated Pure Pursuit for
Robot Path Tracking", 2023.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

Pose = tuple[float, float, float]
Point = tuple[float, float]


@dataclass(frozen=True)
class Limits:
    """Speeds in m/s and rad/s, lengths in m, angles in rad."""

    speed: float = 0.4
    least_speed: float = 0.05
    turn: float = 1.2
    lookahead_s: float = 1.5
    shortest_lookahead: float = 0.3
    longest_lookahead: float = 0.8
    least_radius: float = 0.6
    near_obstacle: float = 0.35
    approach: float = 0.5
    turn_from: float = 0.8
    turn_gain: float = 2.0


def wrapped(angle: float) -> float:
    """Returns an angle between -π and π."""
    return math.atan2(math.sin(angle), math.cos(angle))


def nearest(path: Sequence[Point], pose: Pose, start: int = 0) -> int:
    """Returns the index of the point of the path that is nearest to the robot, not before `start`."""
    return min(range(start, len(path)), key=lambda i: math.dist(path[i], pose[:2]))


def remaining(path: Sequence[Point], index: int) -> float:
    """Returns the length of the path from a point on."""
    return sum(math.dist(a, b) for a, b in zip(path[index:], path[index + 1 :], strict=False))


def point_ahead(path: Sequence[Point], pose: Pose, index: int, distance: float) -> Point:
    """Returns the first point after `index` that is `distance` away from the robot, or the last one."""
    for point in path[index:]:
        if math.dist(point, pose[:2]) >= distance:
            return point
    return path[-1]


def command(  # noqa: PLR0913 - a path, a robot on it, and its surroundings
    path: Sequence[Point],
    pose: Pose,
    speed: float,
    clearance: float,
    *,
    index: int = 0,
    limits: Limits | None = None,
) -> tuple[float, float]:
    """Returns the linear and angular velocity.

    Args:
        path: the points, at least one.
        pose: the robot's x, y and yaw.
        speed: its present speed, which sets how far it looks ahead.
        clearance: the distance from the robot's body to the next obstacle.
        index: the point of the path that is nearest to the robot.
        limits: the largest speeds and accelerations of the robot.
    """
    own = limits or Limits()
    ahead = min(max(abs(speed) * own.lookahead_s, own.shortest_lookahead), own.longest_lookahead)
    x, y = point_ahead(path, pose, index, ahead)
    bearing = wrapped(math.atan2(y - pose[1], x - pose[0]) - pose[2])
    if abs(bearing) > own.turn_from:
        return 0.0, _clipped(own.turn_gain * bearing, own.turn)
    distance = math.dist((x, y), pose[:2])
    if distance < 1e-6:
        return 0.0, 0.0
    curvature = 2 * math.sin(bearing) / distance
    linear = own.speed
    if abs(curvature) * own.least_radius > 1:
        linear *= 1 / (abs(curvature) * own.least_radius)
    if clearance < own.near_obstacle:
        linear *= max(clearance, 0.0) / own.near_obstacle
    left = remaining(path, index)
    if left < own.approach:
        linear *= left / own.approach
    linear = min(max(linear, own.least_speed), own.speed)
    angular = linear * curvature
    if abs(angular) > own.turn:
        linear, angular = linear * own.turn / abs(angular), math.copysign(own.turn, angular)
    return linear, angular


def turn_to(yaw: float, pose: Pose, limits: Limits | None = None) -> float:
    """Returns the angular velocity that turns the robot on the spot to a heading."""
    own = limits or Limits()
    return _clipped(own.turn_gain * wrapped(yaw - pose[2]), own.turn)


def _clipped(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))
