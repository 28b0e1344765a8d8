"""An inertial measurement unit: measures from the pose and velocity of a body. Pure; time is an argument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from executor.world.geometry.transforms import rotate
from executor.world.sensing.noise import generator_at

if TYPE_CHECKING:
    from executor.robots.config import Imu
    from executor.world.geometry.transforms import Pose, Vector

GRAVITY = 9.81


@dataclass(frozen=True)
class ImuReading:
    """A measurement in the sensor's frame: the turning rate in rad/s and the proper acceleration in m/s².

    Args:
        orientation: the quaternion x, y, z, w in the world frame.
        acceleration: the proper acceleration; at rest it is g upwards.
    """

    time_s: float
    orientation: tuple[float, float, float, float]
    rate: tuple[float, float, float]
    acceleration: tuple[float, float, float]


class ImuModel:
    """Computes the mean acceleration over a control period, as a real sensor measures it.

    Attributes:
        seed: the seed of the noise.
    """

    def __init__(self, config: Imu, seed: tuple[int, ...]) -> None:
        self._config = config
        self.seed = seed
        self.has_drawn = False
        self.noise_factor = 1.0
        self.velocity: Vector | None = None
        self._felt: Vector = (0.0, 0.0, GRAVITY)

    def observe(self, velocity: Vector, dt_s: float) -> None:
        """Receives the velocity of the sensor in the world frame, `dt_s` after the last call."""
        old = self.velocity
        if old is not None and dt_s > 0:
            x, y, z = ((now - before) / dt_s for now, before in zip(velocity, old, strict=True))
            self._felt = (x, y, z + GRAVITY)
        self.velocity = velocity

    def save(self) -> list[Any]:
        """Returns the state as plain data."""
        return [None if self.velocity is None else list(self.velocity), list(self._felt), self.has_drawn]

    def restore(self, saved: list[Any]) -> None:
        """Restores a state that `save` returned."""
        velocity, (x, y, z), self.has_drawn = saved
        self.velocity = None if velocity is None else (velocity[0], velocity[1], velocity[2])
        self._felt = (x, y, z)

    def reading(self, time_s: float, pose: Pose, rate: Vector) -> ImuReading:
        """Returns the measurement at a pose; the turning rate is given in the world frame."""
        config = self._config
        into_own = (-pose[3], -pose[4], -pose[5], pose[6])
        self.has_drawn = config.rate_noise > 0 or config.acceleration_noise > 0
        noise = generator_at(time_s, self.seed).normal(0.0, 1.0, 6).tolist()
        turning, felt = rotate(into_own, rate), rotate(into_own, self._felt)
        return ImuReading(
            time_s,
            pose[3:],
            _noisy(turning, noise[:3], config.rate_noise * self.noise_factor),
            _noisy(felt, noise[3:], config.acceleration_noise * self.noise_factor),
        )


def _noisy(vector: Vector, noise: list[float], deviation: float) -> Vector:
    x, y, z = (value + deviation * error for value, error in zip(vector, noise, strict=True))
    return x, y, z
