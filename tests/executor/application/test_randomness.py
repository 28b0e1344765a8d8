"""The random numbers of actions."""

from __future__ import annotations

import random

import numpy as np
import pytest

from executor.application.randomness import NUMPY_SEEDS, seed_randomness


@pytest.mark.parametrize("seed", [0, 7, NUMPY_SEEDS + 7])
def test_the_same_seed_gives_the_same_numbers(seed: int) -> None:
    drawn = []
    for _ in range(2):
        seed_randomness(seed)
        drawn.append((random.random(), float(np.random.rand())))  # noqa: S311 - what actions use
    assert drawn[0] == drawn[1]


def test_whether_a_number_was_drawn_is_known() -> None:
    state = seed_randomness(1)
    assert state.is_untouched
    random.random()  # noqa: S311 - what actions use
    assert not state.is_untouched
