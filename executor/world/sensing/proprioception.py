"""The inner sensors of a robot: IMU, bumper and battery."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.world.geometry.transforms import Pose, Vector, compose, inverse
from executor.world.sensing.battery import BatteryModel
from executor.world.sensing.bumper import Bumper
from executor.world.sensing.imu import ImuModel

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from executor.robots.config import Battery, Imu, RobotConfig
    from executor.world.sensing.battery import BatteryReading
    from executor.world.sensing.bumper import Zone
    from executor.world.sensing.imu import ImuReading


FIRST_IMU: Final = 1000
"""The number of the first IMU in seeds; smaller ones are those of LIDARs."""


class Proprioception:
    """The inner sensors of one robot.

    `pose_of` returns the pose of a link, for the current or a given pose of the root.
    """

    def __init__(self, config: RobotConfig, seed: tuple[int, int], pose_of: Callable[..., Pose]) -> None:
        self._config = config
        self._pose_of = pose_of
        self._imus = {imu.name: ImuModel(imu, (*seed, FIRST_IMU + i)) for i, imu in enumerate(config.imus)}
        self._batteries = {battery.name: BatteryModel(battery) for battery in config.batteries}
        self._bumper = Bumper()
        self._rate: Vector = (0.0, 0.0, 0.0)

    @property
    def has_power(self) -> bool:
        """Whether the battery is not empty."""
        return not any(battery.is_empty for battery in self._batteries.values())

    @property
    def has_drawn(self) -> bool:
        """Whether a measurement with noise was made."""
        return any(imu.has_drawn for imu in self._imus.values())

    @property
    def has_imu(self) -> bool:
        """Whether the robot has an IMU; only an IMU needs velocities."""
        return bool(self._imus)

    def move(self, root: Pose, center: Vector, linear: Vector, rate: Vector, dt_s: float) -> None:
        """Updates the IMU: pose of the root, velocity of the centre of mass, and turning rate."""
        self._rate = rate
        (vx, vy, vz), (wx, wy, wz) = linear, rate
        for imu in self._config.imus:
            at = self._pose_of(imu.link, root)
            x, y, z = at[0] - center[0], at[1] - center[1], at[2] - center[2]
            velocity = (vx + wy * z - wz * y, vy + wz * x - wx * z, vz + wx * y - wy * x)
            self._imus[imu.name].observe(velocity, dt_s)

    def drain(self, effort: float, dt_s: float) -> None:
        """Discharges the battery."""
        for battery in self._batteries.values():
            battery.drain(effort, dt_s)

    def touch(self, point: tuple[float, float, float], now_s: float) -> None:
        """Adds a contact at a point in the world frame, in m."""
        for bumper in self._config.bumpers[:1]:
            x, y, *_ = compose(inverse(self._pose_of(bumper.link)), (*point, 0.0, 0.0, 0.0, 1.0))
            self._bumper.touch(x, y, now_s)

    def pressed(self, now_s: float) -> frozenset[Zone]:
        """Returns the zones of the bumper that are pressed."""
        return self._bumper.pressed(now_s)

    def reseed(self, seed: tuple[int, int]) -> None:
        """Draws the noise of the IMUs from another seed."""
        for i, imu in enumerate(self._imus.values()):
            imu.seed = (*seed, FIRST_IMU + i)

    def scale_noise(self, imu: str, factor: float) -> None:
        """Multiplies the noise of an IMU."""
        self._imus[imu].noise_factor = factor

    def imu(self, imu: Imu, now_s: float) -> ImuReading:
        """Returns a measurement of the IMU at the current time."""
        return self._imus[imu.name].reading(now_s, self._pose_of(imu.link), self._rate)

    def battery(self, battery: Battery) -> BatteryReading:
        """Returns the current state of the battery."""
        return self._batteries[battery.name].reading()

    def save(self) -> dict[str, Any]:
        """Returns the state of all inner sensors as plain data."""
        return {
            "imus": {name: imu.save() for name, imu in self._imus.items()},
            "batteries": {name: battery.save() for name, battery in self._batteries.items()},
            "touched_s": dict(self._bumper.touched_s),
            "rate": list(self._rate),
        }

    def restore(self, saved: Mapping[str, Any]) -> None:
        """Restores a state that `save` returned."""
        for name, imu in self._imus.items():
            imu.restore(saved["imus"][name])
        for name, battery in self._batteries.items():
            battery.restore(saved["batteries"][name])
        self._bumper.touched_s = dict(saved["touched_s"])
        x, y, z = saved["rate"]
        self._rate = (x, y, z)
