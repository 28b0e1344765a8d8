"""Simulates a LIDAR by ray casting."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from executor.world.geometry.transforms import rotation
from executor.world.interface import LidarReading
from executor.world.sensing.noise import generator_at

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.robots.config import Lidar
    from executor.world.geometry.transforms import Pose
    from executor.world.sensing.rays import RayCaster


class LidarCaster:
    """Casts the rays of one LIDAR; they pass through the robot that carries it.

    Args:
        rays: the ray caster.
        config: the number and range of the rays.
        own: the robot's body.
        mask: the collision filter of Bullet, without the group of the robot.
        seed: the seed of the noise.

    Attributes:
        noise_factor: multiplies the noise; faults of evaluations change it.
        seed: the seed of the noise.
    """

    def __init__(self, rays: RayCaster, config: Lidar, own: int, mask: int, seed: tuple[int, ...]) -> None:
        self._rays = rays
        self._config = config
        self._own, self._mask = own, mask
        self.seed = seed
        self.noise_factor = 1.0
        angles = config.angle_min + np.arange(config.rays) * config.angle_increment
        # Rays are slightly longer than the range, so that rounding does not hide hits at the limit.
        self._reach = config.range_max * 1.001
        self._directions = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)]) * self._reach

    def scan(self, time_s: float, pose: Pose) -> LidarReading:
        """Returns a scan from a pose."""
        directions = rotation(pose[3:]) @ self._directions
        fractions = self._rays.cast(pose[:3], directions, self._own, self._mask)
        return LidarReading(time_s, self._valid(fractions * self._reach, fractions < 1.0, time_s), pose)

    def _valid(
        self, distances: NDArray[np.float64], is_hit: NDArray[np.bool_], time_s: float
    ) -> NDArray[np.float32]:
        config = self._config
        deviation = config.noise_m * self.noise_factor
        if deviation > 0:
            noise = generator_at(time_s, self.seed)
            distances = distances + noise.normal(0.0, deviation, len(distances))
        distances = np.where(is_hit & (distances <= config.range_max), distances, np.inf)
        return np.where(distances < config.range_min, -np.inf, distances).astype(np.float32)
