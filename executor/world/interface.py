"""Interface of a world, independent of its physics engine.

Times are simulated seconds, frames follow REP-103.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from executor.messages import Scene
    from executor.robots.config import Battery, Camera, Imu, Lidar, RobotConfig
    from executor.world.geometry.transforms import Pose
    from executor.world.physics.collision import Collision
    from executor.world.physics.drive import Odometry
    from executor.world.sensing.battery import BatteryReading
    from executor.world.sensing.bumper import Zone
    from executor.world.sensing.imu import ImuReading


class WorldError(Exception):
    """The world cannot carry out a request."""


@dataclass(frozen=True)
class LidarReading:
    """One scan, counter-clockwise from straight ahead.

    As in REP-117, +inf is out of range, -inf is too near.
    """

    time_s: float
    ranges: NDArray[np.float32]
    pose: Pose


class Robot(Protocol):
    """One robot of a world."""

    @property
    def id(self) -> str:
        """The robot's name in the universe."""

    @property
    def config(self) -> RobotConfig:
        """The robot's configuration."""

    @property
    def odometry(self) -> Odometry:
        """Pose and twist of the robot as its wheels measure them."""

    @property
    def pose(self) -> tuple[float, float, float]:
        """True pose of the robot: x and y in m, yaw in rad."""

    @property
    def distance_m(self) -> float:
        """Distance in m that the robot has travelled since the start, by its true pose."""

    @property
    def collisions(self) -> int:
        """Number of collisions that the robot caused since the start."""

    @property
    def hits(self) -> int:
        """Number of times that something that moves ran into the robot, which did not drive towards it."""

    def command(self, linear: float, angular: float, at_s: float | None = None) -> bool:
        """Sets the target twist in m/s and rad/s; returns False if it is not finite.

        `at_s` is the simulated time of the command; None is now. The command is valid for the timeout of the
        drive.
        """

    @property
    def base_pose(self) -> Pose:
        """True pose of the root link in the world."""

    @property
    def twist(self) -> tuple[float, float, float]:
        """True speed along the robot's x and y in m/s, and about z in rad/s."""

    def stop(self) -> None:
        """Sets the target velocity to zero."""

    def command_joint(self, joint: str, position: float) -> bool:
        """Sets the target position of a motor's joint in rad or m; returns False if it is not finite."""

    def joint_states(self) -> dict[str, tuple[float, float]]:
        """Returns the position in rad or m and the rate of each joint with a motor; the wheels come first."""

    def scan(self, lidar: Lidar) -> LidarReading:
        """Returns a scan at the current time."""

    def imu(self, imu: Imu) -> ImuReading:
        """Returns a measurement of the IMU at the current time."""

    def battery(self, battery: Battery) -> BatteryReading:
        """Returns the current state of the battery."""

    def pressed(self) -> frozenset[Zone]:
        """Returns the zones of the bumper that are pressed."""

    def camera_pose(self, camera: Camera) -> Pose:
        """Returns the pose of a camera in the world: it looks along x, and z points up in the image."""


class World(Protocol):
    """A simulated world; its time passes only during `step`."""

    @property
    def name(self) -> str:
        """The universe's name."""

    @property
    def time_s(self) -> float:
        """Simulated time in s since the last reset."""

    @property
    def step_s(self) -> float:
        """Length of a step in s."""

    @property
    def scene(self) -> Scene:
        """The scene; `poses` returns the poses of its objects in the same order."""

    @property
    def robots(self) -> Sequence[Robot]:
        """The robots, in the universe's order."""

    def step(self, count: int = 1) -> None:
        """Simulates `count` steps."""

    def reset(self) -> None:
        """Restores the initial state."""

    def reseed(self, seed: int) -> None:
        """Draws all noise from another seed from now on; its own seed changes nothing."""

    def save(self) -> Any:
        """Returns the full state of this world, for `restore`."""

    def restore(self, state: Any) -> None:
        """Restores a saved state; the simulation continues exactly as it did then."""

    def forget(self, state: Any) -> None:
        """Frees a saved state."""

    def dump(self) -> bytes:
        """Returns the full state as plain data, for `load` in another process."""

    def load(self, data: bytes) -> None:
        """Restores a state that `dump` returned, of a world of the same universe, robots and seed.

        Raises:
            WorldError: the data are not such a state.
        """

    def poses(self) -> NDArray[np.float32]:
        """Returns the poses of the scene's objects, one row [x, y, z, qx, qy, qz, qw] each.

        Do not write into the array.
        """

    def read_poses(self) -> Callable[[], NDArray[np.float32]]:
        """Returns a function that computes the present poses at any later time, as `poses` does."""

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        """Moves a body to the pose [x, y, z, roll, pitch, yaw].

        Raises:
            WorldError: there is no such body, or it cannot be moved.
        """

    def take_collisions(self) -> list[tuple[str, Collision]]:
        """Returns the collisions since the last call, each with its robot."""

    def close(self) -> None:
        """Frees the physics engine. May be called twice."""
