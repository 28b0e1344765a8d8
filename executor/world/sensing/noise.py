"""Noise that depends on the seed, the sensor and the time alone: subscribers do not change it."""

from __future__ import annotations

import numpy as np


def generator_at(time_s: float, seed: tuple[int, ...]) -> np.random.Generator:
    """Returns the generator of one measurement; the same seed and time give the same one."""
    return np.random.Generator(np.random.PCG64([*seed, round(time_s * 1e6)]))
