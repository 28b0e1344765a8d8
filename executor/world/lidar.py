"""A LIDAR by ray casting, within the physics server."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from executor.world.interface import LidarReading

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.robots.config import Lidar
    from executor.world.engine import Bullet
    from executor.world.transforms import Pose


class LidarCaster:
    """Casts the rays of one LIDAR; those of its own robot's group pass through the robot."""

    def __init__(self, bullet: Bullet, config: Lidar, filter_mask: int) -> None:
        self._bullet = bullet
        self._config = config
        self._mask = filter_mask
        angles = np.arange(config.rays) * (2 * math.pi / config.rays)
        # A little longer than the range, so that what is just in range is never missed by rounding.
        self._reach = config.range_max * 1.001
        self._directions = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)]) * self._reach

    def scan(self, time_s: float, pose: Pose, noise: np.random.Generator) -> LidarReading:
        """Measures from a pose."""
        ends = (_rotation(pose) @ self._directions).T + np.array(pose[:3])
        starts = [list(pose[:3])] * self._config.rays
        hits = self._bullet.rayTestBatch(starts, ends.tolist(), numThreads=1, collisionFilterMask=self._mask)
        fractions = np.fromiter((hit[2] for hit in hits), np.float64, len(hits))
        return LidarReading(time_s, self._valid(fractions * self._reach, fractions < 1.0, noise), pose)

    def _valid(
        self, distances: NDArray[np.float64], is_hit: NDArray[np.bool_], noise: np.random.Generator
    ) -> NDArray[np.float32]:
        config = self._config
        if config.noise_m > 0:
            distances = distances + noise.normal(0.0, config.noise_m, len(distances))
        distances = np.where(is_hit & (distances <= config.range_max), distances, np.inf)
        return np.where(distances < config.range_min, -np.inf, distances).astype(np.float32)


def _rotation(pose: Pose) -> NDArray[np.float64]:
    x, y, z, w = pose[3:]
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
