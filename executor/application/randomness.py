"""Seeds the random numbers of actions: the global generators of Python and numpy."""

from __future__ import annotations

import random
from dataclasses import dataclass

NUMPY_SEEDS = 2**32  # numpy's legacy generator accepts no others


@dataclass(frozen=True)
class Randomness:
    """The state of both random generators immediately after they were seeded."""

    python: object
    numpy: tuple[bytes, int]

    @property
    def is_untouched(self) -> bool:
        """Whether no random number was drawn since then."""
        return _states() == (self.python, self.numpy)


def seed_randomness(seed: int) -> Randomness:
    """Seeds `random` and `numpy.random`; call it before the actions are loaded.

    `numpy.random.default_rng()` takes its seed from the system and is not affected.
    """
    import numpy as np  # noqa: PLC0415 - the process has it loaded already

    random.seed(seed)
    np.random.seed(seed % NUMPY_SEEDS)
    return Randomness(*_states())


def _states() -> tuple[object, tuple[bytes, int]]:
    import numpy as np  # noqa: PLC0415

    twister = np.random.get_state(legacy=False)["state"]
    return random.getstate(), (twister["key"].tobytes(), twister["pos"])
