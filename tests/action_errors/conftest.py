"""Ends what the tests of this folder have shared."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.executor.warm import WARM

HERE = Path(__file__).parent


@pytest.hookimpl(trylast=True)  # after fixtures that use them
def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    """Ends the warm managers with the last test of the file that uses them."""
    if nextitem is None or nextitem.path != item.path:
        WARM.close()
