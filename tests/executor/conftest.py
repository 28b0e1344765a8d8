"""Ends what several tests of a folder have shared."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.executor.forks import FORKS
from tests.executor.warm import WARM

HERE = Path(__file__).parent


@pytest.hookimpl(trylast=True)  # after fixtures that use them
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Ends the warm managers with the last test of a folder, since one that waits takes memory and time."""
    if nextitem is None or nextitem.path.parent != item.path.parent:
        WARM.close()
    if nextitem is None or not nextitem.path.is_relative_to(HERE):
        FORKS.close()
