"""What a world offers, whatever physics is behind it. Times are simulated seconds, frames follow REP-103."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

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
    """The world cannot do what was asked of it."""


@dataclass(frozen=True)
class LidarReading:
    """One scan, counter-clockwise from straight ahead; REP-117: +inf nothing in range, -inf too near."""

    time_s: float
    ranges: NDArray[np.float32]
    pose: Pose


class Robot(Protocol):
    """One robot of a world."""

    @property
    def id(self) -> str:
        """Its name in the universe."""

    @property
    def config(self) -> RobotConfig:
        """What it is made of."""

    @property
    def odometry(self) -> Odometry:
        """Where the wheels say that it is."""

    @property
    def pose(self) -> tuple[float, float, float]:
        """True x and y in m and yaw in rad."""

    @property
    def distance_m(self) -> float:
        """How far the true pose has travelled since the start."""

    @property
    def collisions(self) -> int:
        """How many times the robot has bumped into something."""

    def command(self, linear: float, angular: float, at_s: float | None = None) -> bool:
        """Sets the wanted twist in m/s and rad/s; refuses (False) one that is not finite.

        `at_s` is when it was wanted, in simulated time; now if None. It holds for the drive's timeout.
        """

    @property
    def base_pose(self) -> Pose:
        """True pose of the root link in the world."""

    @property
    def twist(self) -> tuple[float, float, float]:
        """True speed along x and y of the robot, in m/s, and about z, in rad/s."""

    def stop(self) -> None:
        """Wants no motion any more."""

    def command_joint(self, joint: str, position: float) -> bool:
        """Sets where a joint with a motor is wanted, in rad or m; refuses (False) what is no number."""

    def joint_states(self) -> dict[str, tuple[float, float]]:
        """Position in rad or m and rate of each joint that has a motor, the wheels' first."""

    def scan(self, lidar: Lidar) -> LidarReading:
        """Measures now."""

    def imu(self, imu: Imu) -> ImuReading:
        """Measures now."""

    def battery(self, battery: Battery) -> BatteryReading:
        """Measures now."""

    def pressed(self) -> frozenset[Zone]:
        """Returns the zones of the bumper that are pressed."""

    def camera_pose(self, camera: Camera) -> Pose:
        """Where a camera is in the world; it looks along x, z is up in the picture."""


class World(Protocol):
    """A simulated world that stands still until it is stepped."""

    @property
    def name(self) -> str:
        """The universe's name."""

    @property
    def time_s(self) -> float:
        """Simulated time since the last reset."""

    @property
    def step_s(self) -> float:
        """Length of a step."""

    @property
    def scene(self) -> Scene:
        """What there is to see; `poses` are of its objects, in their order."""

    @property
    def robots(self) -> Sequence[Robot]:
        """The robots, in the universe's order."""

    def step(self, count: int = 1) -> None:
        """Simulates `count` steps."""

    def reset(self) -> None:
        """Makes the world anew, as it was at the start."""

    def save(self) -> Any:
        """Returns the whole state; hand it to `restore` of the same world."""

    def restore(self, state: Any) -> None:
        """Goes on from a saved state exactly as the world did then."""

    def forget(self, state: Any) -> None:
        """Frees a saved state."""

    def poses(self) -> NDArray[np.float32]:
        """Poses of the scene's objects, one row [x, y, z, qx, qy, qz, qw] each. Do not write into it."""

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        """Drags a body to [x, y, z, roll, pitch, yaw].

        Raises:
            WorldError: there is no such body, or it cannot be moved.
        """

    def take_collisions(self) -> list[tuple[str, Collision]]:
        """Returns (robot, collision) of those that happened since the last call."""

    def close(self) -> None:
        """Frees the physics. May be called twice."""
