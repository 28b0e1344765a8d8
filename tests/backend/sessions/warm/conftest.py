"""A launcher of pods for all of the server, on a fake cluster."""

from __future__ import annotations

import pytest

from backend.config.environment import environment
from backend.sessions.lifecycle import writes
from backend.sessions.warm import pool
from tests.backend.sessions.launchers.kubernetes.conftest import client, cluster, launcher


class Now:
    """Does at once what is submitted to it."""

    def submit(self, do, *arguments):
        do(*arguments)


@pytest.fixture
def pods(launcher, monkeypatch):
    """The launcher, with two executors that are kept warm; what the pool starts is there at once."""
    changed = environment().model_copy(update={"warm_sessions": 2})
    for module in (writes, pool):
        monkeypatch.setattr(module, "launcher", lambda: launcher)
    monkeypatch.setattr(pool, "environment", lambda: changed)
    monkeypatch.setattr(pool, "workers", Now)
    monkeypatch.setattr(pool, "connection", _Open())
    monkeypatch.setattr(pool, "failure", pool._Failure())
    return launcher


class _Open:
    """A connection that stays open, since the test uses it afterwards."""

    def close(self):
        """Does nothing."""


__all__ = ["client", "cluster", "launcher"]
