"""Robots: a URDF for the body, and a configuration for drive and sensors."""

from executor.robots.config import Drive, RobotConfig, RobotError, load_robot, robot_ids
from executor.robots.sensors import Battery, Bumper, Camera, Imu, Lidar
from executor.robots.urdf import Joint, Link, Urdf, UrdfError, Visual, parse_urdf

__all__ = [
    "Battery",
    "Bumper",
    "Camera",
    "Drive",
    "Imu",
    "Joint",
    "Lidar",
    "Link",
    "RobotConfig",
    "RobotError",
    "Urdf",
    "UrdfError",
    "Visual",
    "load_robot",
    "parse_urdf",
    "robot_ids",
]
