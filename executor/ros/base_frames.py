"""The base frames of a robot, with the names of TurtleBot3: `odom`, `base_footprint`, `base_link`.

`base_footprint` is on the ground below the robot; odometry and ground truth report the pose of this frame.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from executor.ros import messages
from executor.world.geometry.transforms import IDENTITY, Pose, compose, inverse

if TYPE_CHECKING:
    from executor.robots.config import RobotConfig
    from executor.world.interface import Robot


def fixed_transforms(config: RobotConfig, prefix: str = "") -> list[Any]:
    """Returns the fixed transforms from `base_footprint` to the root of the URDF.

    None if the URDF has that frame itself.

    `base_link` exists also for a robot whose links have other names.
    """
    links, root = config.urdf.links, config.urdf.root
    chain: list[tuple[str, str, Pose]] = []
    if messages.BASE_FRAME not in links:
        chain.append((messages.BASE_FRAME, root, footprint_of(config)))
        if messages.LINK_FRAME not in links:
            chain = [(messages.BASE_FRAME, messages.LINK_FRAME, footprint_of(config))]
            chain.append((messages.LINK_FRAME, root, IDENTITY))
    return [messages.transform(prefix + parent, prefix + child, pose) for parent, child, pose in chain]


def footprint_of(config: RobotConfig) -> Pose:
    """Returns the pose of the root link in `base_footprint`.

    The height follows from the wheels, which touch the ground.
    """
    joint = config.urdf.joints[config.drive.left[0]]
    _, above = config.urdf.rigid_parent(joint.parent)
    height = config.drive.wheel_radius - compose(above, joint.origin)[2]
    return (0.0, 0.0, height, 0.0, 0.0, 0.0, 1.0)


def odometry_frame(config: RobotConfig) -> str:
    """Returns the child frame of odometry.

    It is `base_footprint`, unless that is a link below the URDF's root; then it is the root.
    """
    below = messages.BASE_FRAME in config.urdf.links and config.urdf.root != messages.BASE_FRAME
    return config.urdf.root if below else messages.BASE_FRAME


def true_odometry(robot: Robot, now_s: float, prefix: str) -> Any:
    """Returns the message of `/ground_truth/odom`, the true pose and twist of a robot."""
    config = robot.config
    base = robot.base_pose
    if odometry_frame(config) != config.urdf.root:
        base = compose(base, inverse(footprint_of(config)))
    return messages.ground_truth(base, robot.twist, now_s, prefix, odometry_frame(config))
