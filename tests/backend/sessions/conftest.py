"""Launchers that start fake managers."""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from backend.sessions.launchers.base import Spec
from backend.sessions.launchers.process import ProcessLauncher
from backend.sessions.lifecycle import writes
from tests.backend.accounts.conftest import person, stranger, team
from tests.budget import count
from tests.processes import command_line

FAKE = Path(__file__).parents[2] / "fakes" / "manager.py"

# It takes four minutes, so only the large counts of `make test-full` have it.
collect_ignore = [] if count("backend_chaos_blows") else ["test_chaos.py"]


def spec(**changes):
    values: dict[str, Any] = {
        "session_id": "s1",
        "token": "t0ken",
        "ros_domain_id": 51,
        "start_timeout_s": 60,
        "stop_timeout_s": 1,
    }
    return Spec(**values | changes)


# The workers of the pool, and the object store and PostgreSQL of the tests, live as long as this process.
LASTING = {"backend.workers.worker", "moto.server", "tests.backend.preloaded"}
# The children that there were before a test.
BEFORE: set[psutil.Process] = set()
PR_SET_CHILD_SUBREAPER = 36


@pytest.fixture(autouse=True)
def _children_before():
    # An executor's supervisor, of another test in this process, adopts orphans; the server does not.
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0)
    BEFORE.clear()
    BEFORE.update(psutil.Process().children(recursive=True))


def children():
    """Returns the children that this process got in a test, except those that last."""
    return [
        child
        for child in set(psutil.Process().children(recursive=True)) - BEFORE
        if LASTING.isdisjoint(line := command_line(child))
        and not any("postgres" in word for word in line[:1])
    ]


@pytest.fixture
def launcher_of(tmp_path):
    """Makes launchers, and ends what a failed test leaves behind."""
    made = []

    def make(kind, program=sys.executable):
        launcher = ProcessLauncher(tmp_path / "logs", (program, str(FAKE), kind))
        made.append(launcher)
        return launcher

    yield make
    for launcher in made:
        launcher.close()
    assert children() == []


@pytest.fixture
def fake_manager(launcher_of, monkeypatch):
    """Makes sessions start fake managers of a kind."""

    def use(kind):
        launcher = launcher_of(kind)
        monkeypatch.setattr(writes, "launcher", lambda: launcher)
        return launcher

    return use


__all__ = ["person", "stranger", "team"]
