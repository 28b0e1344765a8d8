"""Numbers of cases for tests that could run for any time."""

from __future__ import annotations

import os
from pathlib import Path

_BUDGET = Path(__file__).with_name("budget.toml")
IS_FULL = os.environ.get("BT_STUDIO_FULL") == "1"


def count(name: str) -> int:
    """Returns how many cases the counted test `name` runs this time.

    Raises:
        KeyError: `tests/budget.toml` has no such table.
    """
    import tomllib  # the engine's tests run on Python 3.10, too, which has none

    table = tomllib.loads(_BUDGET.read_text())[name]
    return int(table["full" if IS_FULL else "test"])
