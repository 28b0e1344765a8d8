"""Rules that hold for all tests."""

from __future__ import annotations

import gc
import logging
import os
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

import hypothesis
import pytest

from executor.supervision import scratch
from executor.supervision.locks import is_young
from tests.budget import IS_FULL

if TYPE_CHECKING:
    from collections.abc import Iterator

# The duration of an example depends on the machine. The short run tries the same examples each time, so its
# result depends on the change alone; the long run searches for new ones.
hypothesis.settings.register_profile(
    "bt_studio",
    deadline=None,
    derandomize=not IS_FULL,
    suppress_health_check=[hypothesis.HealthCheck.too_slow],
)
hypothesis.settings.load_profile("bt_studio")

# Without stored bytecode each process of a test compiles its modules again: a third of the suite's time.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

# A shell that runs the suite in the background ignores Ctrl+C for it, and what tests start inherits that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

pytest_plugins = ["tests.leaks"]

BROWSER_TESTS = "tests/e2e/"
gc.disable()  # while tests are collected, nothing becomes garbage


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Runs the browser's tests last: Playwright's event loop occupies the main thread."""
    items.sort(key=lambda item: item.nodeid.startswith(BROWSER_TESTS))


def pytest_collection_finish() -> None:
    """Excludes what is loaded by now from garbage collections: a full one then took 0.3 s."""
    gc.collect()
    gc.freeze()
    gc.enable()


@pytest.fixture(autouse=True)
def _what_belongs_to_the_process() -> Iterator[None]:
    """Takes back what a test left in this process: keys of py_trees, and loggers that reach nobody else."""
    yield
    if board := sys.modules.get("py_trees.blackboard"):
        board.Blackboard.clear()
    logging.getLogger("executor").propagate = True
    logging.getLogger("executor.robots").setLevel(logging.NOTSET)


@pytest.fixture(scope="session", autouse=True)
def _what_killed_processes_leave() -> Iterator[None]:
    """Removes it as the next start of an executor does, so that the search for leaks finds only the rest."""
    yield
    place = Path(tempfile.gettempdir())
    while any(lock.exists() and is_young(lock) for lock in place.glob(f"{scratch.PREFIX}*/{scratch.LOCK}")):
        time.sleep(0.05)  # a lock is young by the machine's clock
    scratch.remove_abandoned(place)
