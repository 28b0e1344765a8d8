"""Rules that hold for all tests."""

from __future__ import annotations

import gc
import signal
from pathlib import Path
from typing import TYPE_CHECKING

import hypothesis

from tests.budget import IS_FULL

if TYPE_CHECKING:
    import pytest

# The duration of an example depends on the machine. The short run tries the same examples each time, so its
# result depends on the change alone; the long run searches for new ones.
hypothesis.settings.register_profile(
    "bt_studio",
    deadline=None,
    derandomize=not IS_FULL,
    suppress_health_check=[hypothesis.HealthCheck.too_slow],
)
hypothesis.settings.load_profile("bt_studio")

# A shell that runs the suite in the background ignores Ctrl+C for it, and what tests start inherits that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

BROWSER_TESTS = Path(__file__).parent / "e2e"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Runs the browser's tests last: Playwright's event loop occupies the main thread."""
    items.sort(key=lambda item: BROWSER_TESTS in item.path.parents)


def pytest_collection_finish() -> None:
    """Excludes what is loaded by now from garbage collections: a full one then took 0.3 s."""
    gc.collect()
    gc.freeze()
