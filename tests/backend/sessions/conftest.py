"""Launchers that start fake managers."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import psutil
import pytest

from backend.sessions.launchers.base import Spec
from backend.sessions.launchers.process import ProcessLauncher
from backend.sessions.lifecycle import writes
from tests.backend.accounts.conftest import person, stranger, team
from tests.processes import command_line

FAKE = Path(__file__).parents[2] / "fakes" / "manager.py"


def spec(**changes):
    values: dict[str, Any] = {
        "session_id": "s1",
        "token": "t0ken",
        "ros_domain_id": 51,
        "start_timeout_s": 60,
        "stop_timeout_s": 1,
    }
    return Spec(**values | changes)


# The workers of the pool, and the object store of the tests, live as long as this process.
LASTING = {"backend.workers.worker", "moto.server"}


def children():
    """Returns the children of this process, except those that last."""
    return [
        child
        for child in psutil.Process().children(recursive=True)
        if LASTING.isdisjoint(command_line(child))
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
