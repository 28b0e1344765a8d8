"""Noise that depends only on the seed, the sensor and the time, so that subscribers do not change it."""

from __future__ import annotations

import numpy as np


def generator_at(time_s: float, seed: tuple[int, ...]) -> np.random.Generator:
    """Returns the random generator of one measurement; equal seeds and times give equal generators."""
    return np.random.Generator(np.random.PCG64([*seed, round(time_s * 1e6)]))
