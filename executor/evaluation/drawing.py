"""Draws values. Each address has a generator of its own, so that no entry changes the values of another."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING

import numpy as np

from executor.evaluation.areas import draw_in

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.evaluation.document import Draw

Value = float | int | bool | str


def generator_of(seed: int, address: str, attempt: int = 0) -> np.random.Generator:
    """Returns the generator of one address: PCG64, seeded with SHA-256 of seed, address and attempt.

    The hashed text is the three parts, each followed by a line feed; the digest is one big-endian number.
    """
    digest = hashlib.sha256(f"{seed}\n{address}\n{attempt}\n".encode()).digest()
    return np.random.Generator(np.random.PCG64(int.from_bytes(digest, "big")))


def draw_value(draw: Draw, seed: int, address: str, attempt: int = 0, *, whole: bool = False) -> Value:
    """Returns a value of a draw that is no pose; with `whole`, a uniform range gives whole numbers."""
    generator = generator_of(seed, address, attempt)
    if draw.choice is not None:
        return draw.choice[int(generator.integers(len(draw.choice)))]
    if draw.normal is not None and draw.clip is not None:
        value = float(generator.normal(*draw.normal))
        return min(max(value, draw.clip[0]), draw.clip[1])
    low, high = draw.uniform or (0.0, 0.0)
    if whole:
        return int(generator.integers(round(low), round(high) + 1))
    return float(generator.uniform(low, high))


def draw_pose(  # noqa: PLR0913, PLR0917 - all of these decide the pose
    draw: Draw,
    corners: Sequence[tuple[float, float]],
    before: Sequence[float],
    seed: int,
    address: str,
    attempt: int,
) -> tuple[float, float, float, float, float, float]:
    """Returns a pose [x, y, z, roll, pitch, yaw] in an area; height and tilt are those of `before`.

    Without a range of `yaw`, the yaw is that of `before`, too.
    """
    generator = generator_of(seed, address, attempt)
    x, y = draw_in(corners, generator)
    yaw = before[5] if draw.yaw is None else float(generator.uniform(*draw.yaw))
    return x, y, before[2], before[3], before[4], yaw


def bounds_of(draw: Draw) -> list[Value]:
    """Returns the values at the bounds of a draw that is no pose: the extremes, or every choice."""
    if draw.choice is not None:
        return list(draw.choice)
    return list(draw.clip or draw.uniform or ())


def draw_range(value: float | tuple[float, float], seed: int, address: str) -> float:
    """Returns a number, drawn if it is a range."""
    if isinstance(value, tuple):
        return float(generator_of(seed, address).uniform(*value))
    return value
