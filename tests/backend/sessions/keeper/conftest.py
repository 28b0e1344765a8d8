"""A keeper with a fake engine, and the launcher that asks it."""

from __future__ import annotations

import tempfile
import threading
from pathlib import Path

import pytest

from backend.sessions.gate.doors import Doors
from backend.sessions.gate.server import GateServer
from backend.sessions.keeper.docker import Docker
from backend.sessions.keeper.gate import Gate
from backend.sessions.keeper.plan import Limits, Plan
from backend.sessions.keeper.server import KeeperServer
from backend.sessions.keeper.service import Keeper
from backend.sessions.keeper.tools import ToolsKeeper
from backend.sessions.launchers.docker import DockerLauncher
from tests.fakes.docker import FakeDocker, control_of, gate_of


class Host:
    """All services beside a web server."""

    def __init__(self, folder, image, max_sessions, patience_s, **options):
        self.folder = folder / "keeper"
        self.start_gate()
        self.gate = Gate(control_of(folder), self.folder / "sessions", patience_s=patience_s)
        self.docker = FakeDocker(folder / "docker.sock", gate_of(folder))
        plan = Plan(image, "gate", "stack", limits=Limits(memory_mb=512, hours=2))
        engine = Docker(str(folder / "docker.sock"))
        self.keeper = Keeper(engine, self.gate, plan, max_sessions=max_sessions, **options)
        self.tools = ToolsKeeper(engine, self.gate, plan, max_tools=max_sessions)
        self.server = KeeperServer(self.folder / "keeper.sock", self.keeper, self.tools)
        self.launcher = DockerLauncher(self.folder)
        self._thread = threading.Thread(target=lambda: self.server.serve_forever(0.05), daemon=True)
        self._thread.start()

    def start_gate(self):
        self._gate_server = GateServer(Doors(gate_of(self.folder.parent)), control_of(self.folder.parent))
        self._gate_thread = threading.Thread(target=self._gate_server.serve, daemon=True)
        self._gate_thread.start()

    def end_gate(self):
        self._gate_server.end()
        self._gate_thread.join(60)

    @property
    def doors(self):
        return sorted(path.name for path in gate_of(self.folder.parent).iterdir())

    @property
    def sockets(self):
        return sorted(path.name for path in (self.folder / "sessions").iterdir())

    def close(self):
        self.server.shutdown()
        self.server.server_close()
        self.end_gate()
        self.docker.close()
        self._thread.join(60)


@pytest.fixture
def folder():
    """A folder with a short name: the path of a socket holds 107 bytes."""
    with tempfile.TemporaryDirectory() as made:
        yield Path(made)


@pytest.fixture
def host_of(folder):
    """Makes a host whose executors behave as a kind does."""
    made = []

    def make(image="good", max_sessions=2, patience_s=60, **options):
        made.append(Host(folder, image, max_sessions, patience_s, **options))
        return made[-1]

    yield make
    for host in made:
        host.close()
