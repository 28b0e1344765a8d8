"""Numbers of cases for tests that could run for any time."""

from __future__ import annotations

import os
from pathlib import Path

_BUDGET = Path(__file__).with_name("budget.toml")
IS_FULL = os.environ.get("BT_STUDIO_FULL") == "1"
PART = os.environ.get("BT_STUDIO_PART", "1/1")
"""Which part of the seeds is run, such as `3/10`: a long suite is then run in pieces."""


def count(name: str) -> int:
    """Returns how many cases the counted test `name` runs this time.

    Raises:
        KeyError: `tests/budget.toml` has no such table.
    """
    import tomllib  # the engine's tests run on Python 3.10, too, which has none

    table = tomllib.loads(_BUDGET.read_text())[name]
    return int(table["full" if IS_FULL else "test"])


def seeds(name: str, first: int = 1, part: str = PART) -> range:
    """Returns the seeds of the counted test `name` that are run this time; all parts together have all.

    Raises:
        KeyError: `tests/budget.toml` has no such table.
        ValueError: the part is not as in `3/10`.
    """
    number, _, parts = part.partition("/")
    index, of = int(number), int(parts)
    if not 1 <= index <= of:
        raise ValueError(f"BT_STUDIO_PART={part}: expected a part such as 3/10")
    total = count(name)
    return range(first + total * (index - 1) // of, first + total * index // of)
