"""Noise depends on the seed, the sensor and the time alone."""

from __future__ import annotations

from executor.world.sensing.noise import generator_at


def test_the_same_moment_gives_the_same_noise() -> None:
    drawn = [
        generator_at(time_s, seed).normal() for time_s, seed in ((1.0, (1, 2)), (1.0, (1, 2)), (1.1, (1, 2)))
    ]
    assert drawn[0] == drawn[1] != drawn[2]
    assert generator_at(1.0, (1, 3)).normal() != drawn[0]
