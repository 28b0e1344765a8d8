"""A real manager that listens at a socket from the gate."""

from __future__ import annotations

import asyncio
import json
import socket
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from websockets.asyncio.client import unix_connect

from backend.sessions.gate.client import Door
from backend.sessions.gate.doors import Doors, listen_at
from backend.sessions.gate.server import GateServer
from executor.manager.gate import fetch_listener
from tests.executor.session_client import TOKEN, manager_process


class Gate:
    """A gate, with the keeper's end of it."""

    def __init__(self, folder):
        self._folder = folder
        self._doors, self._control = folder / "gate", folder / "control" / "gate.sock"
        self.path = folder / "s1.sock"
        self._listener = listen_at(self.path)
        self.door = Door(self._control, self._listener, "s1", TOKEN)
        self.start()

    def start(self):
        self._server = GateServer(Doors(self._doors), self._control)
        self._thread = threading.Thread(target=self._server.serve, daemon=True)
        self._thread.start()

    def end(self):
        self._server.end()
        self._thread.join(60)

    def close(self):
        self.door.close()
        self._listener.close()
        self.end()

    @property
    def entrance(self):
        return self._doors / self.door.path


@pytest.fixture
def gate():
    with tempfile.TemporaryDirectory() as name:
        made = Gate(Path(name))
        yield made
        made.close()


async def test_a_manager_listens_at_the_socket_that_it_was_handed(gate):
    gate.door.open()
    async with manager_process("--gate", str(gate.entrance), "--session", "s1"):
        assert await asyncio.to_thread(gate.door.wait, 60)
        headers = {"Authorization": f"Bearer {TOKEN}"}
        async with unix_connect(
            str(gate.path), "ws://localhost/control", additional_headers=headers
        ) as connection:
            async with asyncio.timeout(60):
                first = json.loads(await connection.recv())
        assert first["command"] == "introspection"


def test_a_wrong_token_gets_nothing_and_the_right_one_opens_once(gate):
    gate.door.open()
    with pytest.raises(PermissionError, match="does not know"):
        fetch_listener(gate.entrance, "s1", "wrong")
    fetch_listener(gate.entrance, "s1", TOKEN).close()
    assert gate.door.wait(60)
    with pytest.raises(FileNotFoundError):
        fetch_listener(gate.entrance, "s1", TOKEN, timeout_s=0)


def test_a_gate_that_is_being_started_again_is_waited_for(gate):
    gate.door.open()
    gate.end()
    assert not gate.entrance.exists()
    with ThreadPoolExecutor(1) as session:
        fetching = session.submit(fetch_listener, gate.entrance, "s1", TOKEN, timeout_s=60)
        gate.start()
        while not gate.door.wait(0.1):
            pass
        with fetching.result(60) as listener:
            assert listener.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN) == 1
