"""Noise that depends only on the seed, the sensor and the time, so that subscribers do not change it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping


def generator_at(time_s: float, seed: tuple[int, ...]) -> np.random.Generator:
    """Returns the random generator of one measurement; equal seeds and times give equal generators."""
    return np.random.Generator(np.random.PCG64([*seed, round(time_s * 1e6)]))


def plain_generator(generator: np.random.Generator) -> dict[str, Any]:
    """Returns the state of a PCG64 generator as plain data; its numbers have 128 bits, so they are texts."""
    state: dict[str, Any] = dict(generator.bit_generator.state)
    return {**state, "state": {name: hex(number) for name, number in state["state"].items()}}


def restore_generator(generator: np.random.Generator, plain: Mapping[str, Any]) -> None:
    """Restores a state that `plain_generator` returned."""
    numbers = {name: int(text, 16) for name, text in plain["state"].items()}
    generator.bit_generator.state = {**plain, "state": numbers}
