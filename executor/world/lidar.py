"""A LIDAR by ray casting, within the physics server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from executor.world.interface import LidarReading
from executor.world.noise import generator_at
from executor.world.transforms import rotation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.robots.config import Lidar
    from executor.world.engine import Bullet
    from executor.world.transforms import Pose


class LidarCaster:
    """Casts the rays of one LIDAR; those of its own robot's group pass through the robot."""

    def __init__(self, bullet: Bullet, config: Lidar, filter_mask: int, seed: tuple[int, ...]) -> None:
        self._bullet = bullet
        self._config = config
        self._mask = filter_mask
        self._seed = seed
        angles = config.angle_min + np.arange(config.rays) * config.angle_increment
        # A little longer than the range, so that what is just in range is never missed by rounding.
        self._reach = config.range_max * 1.001
        self._directions = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)]) * self._reach

    def scan(self, time_s: float, pose: Pose) -> LidarReading:
        """Measures from a pose."""
        ends = (rotation(pose[3:]) @ self._directions).T + np.array(pose[:3])
        starts = [list(pose[:3])] * self._config.rays
        hits = self._bullet.rayTestBatch(starts, ends.tolist(), numThreads=1, collisionFilterMask=self._mask)
        fractions = np.fromiter((hit[2] for hit in hits), np.float64, len(hits))
        return LidarReading(time_s, self._valid(fractions * self._reach, fractions < 1.0, time_s), pose)

    def _valid(
        self, distances: NDArray[np.float64], is_hit: NDArray[np.bool_], time_s: float
    ) -> NDArray[np.float32]:
        config = self._config
        if config.noise_m > 0:
            noise = generator_at(time_s, self._seed)
            distances = distances + noise.normal(0.0, config.noise_m, len(distances))
        distances = np.where(is_hit & (distances <= config.range_max), distances, np.inf)
        return np.where(distances < config.range_min, -np.inf, distances).astype(np.float32)
