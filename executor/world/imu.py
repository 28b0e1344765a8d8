"""An inertial measurement unit: what a body at a pose with a velocity feels. Pure; time is an argument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from executor.world.noise import generator_at
from executor.world.transforms import Pose, rotation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.robots.config import Imu

    Vector = NDArray[np.float64]

GRAVITY = (0.0, 0.0, -9.81)


@dataclass(frozen=True)
class ImuReading:
    """In the sensor's own frame: turning rate in rad/s, proper acceleration in m/s² (at rest +g upwards).

    Args:
        orientation: quaternion x, y, z, w in the world frame.
    """

    time_s: float
    orientation: tuple[float, float, float, float]
    rate: tuple[float, float, float]
    acceleration: tuple[float, float, float]


class ImuModel:
    """Works the acceleration out from one control period to the next, as the real thing averages."""

    def __init__(self, config: Imu, seed: tuple[int, ...]) -> None:
        self._config = config
        self._seed = seed
        self.velocity: tuple[float, float, float] | None = None
        self._felt: Vector = -np.array(GRAVITY)

    def observe(self, velocity: Vector, dt_s: float) -> None:
        """Takes the velocity of the sensor in the world frame, `dt_s` after the last one."""
        if self.velocity is not None and dt_s > 0:
            self._felt = (velocity - np.array(self.velocity)) / dt_s - np.array(GRAVITY)
        self.velocity = (float(velocity[0]), float(velocity[1]), float(velocity[2]))

    def reading(self, time_s: float, pose: Pose, rate: Vector) -> ImuReading:
        """Returns the measurement at a pose, with a turning rate in the world frame."""
        config = self._config
        into_own = rotation(pose[3:]).T
        noise = generator_at(time_s, self._seed)
        turning = into_own @ rate + noise.normal(0.0, 1.0, 3) * config.rate_noise
        felt = into_own @ self._felt + noise.normal(0.0, 1.0, 3) * config.acceleration_noise
        return ImuReading(time_s, pose[3:], _triple(turning), _triple(felt))


def _triple(vector: Vector) -> tuple[float, float, float]:
    return float(vector[0]), float(vector[1]), float(vector[2])
