"""A keeper with a fake engine, and the launcher that asks it."""

from __future__ import annotations

import tempfile
import threading
from pathlib import Path

import pytest

from backend.sessions.keeper.docker import Docker
from backend.sessions.keeper.gate import Gate
from backend.sessions.keeper.plan import Limits, Plan
from backend.sessions.keeper.server import KeeperServer
from backend.sessions.keeper.service import Keeper
from backend.sessions.keeper.tools import ToolsKeeper
from backend.sessions.launchers.docker import DockerLauncher
from tests.fakes.docker import FakeDocker, gate_of


class Host:
    """Everything that stands beside a web server."""

    def __init__(self, folder, image, max_sessions):
        self.folder = folder / "keeper"
        self.gate = Gate(gate_of(folder), self.folder / "sessions")
        self.docker = FakeDocker(folder / "docker.sock", gate_of(folder))
        plan = Plan(image, "gate", "stack", limits=Limits(memory_mb=512, hours=2))
        engine = Docker(str(folder / "docker.sock"))
        self.keeper = Keeper(engine, self.gate, plan, max_sessions=max_sessions)
        self.tools = ToolsKeeper(engine, self.gate, plan, max_tools=max_sessions)
        self.server = KeeperServer(self.folder / "keeper.sock", self.keeper, self.tools)
        self.launcher = DockerLauncher(self.folder)
        self._threads = [
            threading.Thread(target=target, daemon=True)
            for target in (self.gate.serve, lambda: self.server.serve_forever(0.05))
        ]
        for thread in self._threads:
            thread.start()

    @property
    def sockets(self):
        return sorted(path.name for path in (self.folder / "sessions").iterdir())

    def close(self):
        self.server.shutdown()
        self.server.server_close()
        self.gate.close()
        self.docker.close()
        for thread in self._threads:
            thread.join(5)


@pytest.fixture
def folder():
    """A folder with a short name: the path of a socket holds 107 bytes."""
    with tempfile.TemporaryDirectory() as made:
        yield Path(made)


@pytest.fixture
def host_of(folder):
    """Makes a host whose executors behave as a kind does."""
    made = []

    def make(image="good", max_sessions=2):
        made.append(Host(folder, image, max_sessions))
        return made[-1]

    yield make
    for host in made:
        host.close()
