"""Managers that serve several tests: each is started once, and is reset by what a client may command.

A test that ends processes of a session, or needs other settings, starts its own manager.
"""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import psutil

from executor.manager.manager import free_domain_id
from tests.executor.session_client import TOKEN, SessionClient

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Mapping

__all__ = ["REAL", "WARM", "WarmManager", "warm_session"]

ROOT: Final = Path(__file__).parents[2]
REAL: Final = ("executor.manager", "--port", "0", "--grace", "0", "--token-env", "TOKEN")
"""The module and the options of a manager with the real world."""
RUNS: Final = {"application_running", "paused", "held"}


class WarmManager:
    """A manager process, which serves one test after another.

    Attributes:
        pid: its process.
        port: where it listens.
        outside_domain_id: the ROS domain of the user's own programs.
    """

    def __init__(self, module: str, *arguments: str) -> None:
        reader, writer = os.pipe()
        # The graph of the user's own programs is a free one, too: several test runs share a machine.
        self.outside_domain_id = free_domain_id()
        own = {"TOKEN": TOKEN, "ROS_DOMAIN_ID": str(self.outside_domain_id)}
        with os.fdopen(reader) as ready:
            self._process = subprocess.Popen(
                [sys.executable, "-m", module, *arguments, "--ready-fd", str(writer)],
                pass_fds=[writer],
                cwd=ROOT,
                env={**os.environ, **own},
            )
            os.close(writer)
            self.ready: dict[str, Any] = json.loads(ready.readline())
        self.pid, self.port = self._process.pid, int(self.ready["port"])

    def close(self) -> None:
        """Ends it; nothing of it may be left."""
        family = []
        with contextlib.suppress(psutil.NoSuchProcess):
            family = psutil.Process(self.pid).children(recursive=True)
        self._process.terminate()
        self._process.wait(120)
        assert psutil.wait_procs(family, timeout=120)[1] == []


class WarmManagers:
    """The managers of this process, by their command; `close` is called after the tests of a folder."""

    def __init__(self) -> None:
        self._managers: dict[tuple[str, ...], WarmManager] = {}

    def get(self, command: tuple[str, ...]) -> WarmManager:
        """Returns the manager of a command, which is started if there is none."""
        if command not in self._managers:
            self._managers[command] = WarmManager(*command)
        return self._managers[command]

    def drop(self, command: tuple[str, ...]) -> None:
        """Ends a manager after a test that has failed."""
        self._managers.pop(command).close()

    def close(self) -> None:
        """Ends all managers."""
        while self._managers:
            self._managers.popitem()[1].close()


WARM: Final = WarmManagers()


@contextlib.asynccontextmanager
async def warm_session(
    *command: str, stream: bool = True, headers: Mapping[str, str] | None = None
) -> AsyncIterator[tuple[WarmManager, SessionClient]]:
    """Opens the session of a warm manager, which afterwards has no run and no breakpoints.

    Its world stays, since the next run resets it.
    """
    manager = WARM.get(command or REAL)
    try:
        client = SessionClient(manager.port)
        client.headers |= headers or {}
        await client.open(stream=stream)
        if client.named("introspection")[0]["role"] != "driver":
            assert await client.ask("take_over") == "ack"
        yield manager, client
        await _reset(client)
        await client.close()
    except BaseException:
        WARM.drop(command or REAL)
        raise


async def _reset(client: SessionClient) -> None:
    assert await client.ask("cancel") == "ack"
    if client.state in RUNS:
        assert await client.ask("terminate_application") == "ack"
    assert await client.ask("set_breakpoints", {"breakpoints": []}) == "ack"
