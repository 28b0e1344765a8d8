"""A real manager that is reached by a socket which the gate handed to it."""

from __future__ import annotations

import asyncio
import json
import tempfile
import threading
from pathlib import Path

import pytest
from websockets.asyncio.client import unix_connect

from backend.sessions.keeper.gate import Gate
from executor.manager.gate import fetch_listener
from tests.executor.session_client import TOKEN, manager_process


@pytest.fixture
def gate():
    with tempfile.TemporaryDirectory() as name:
        made = Gate(Path(name) / "gate", Path(name) / "sessions")
        thread = threading.Thread(target=made.serve, daemon=True)
        thread.start()
        made.folder = Path(name) / "gate"
        yield made
        made.close()
        thread.join(5)


async def test_a_manager_listens_at_the_socket_that_it_was_handed(gate):
    arrived = gate.expect("s1", TOKEN)
    door = str(gate.folder / "gate.sock")
    async with manager_process("--gate", door, "--session", "s1"):
        assert arrived.is_set()
        headers = {"Authorization": f"Bearer {TOKEN}"}
        async with unix_connect(
            str(gate.path("s1")), "ws://localhost/control", additional_headers=headers
        ) as socket:
            async with asyncio.timeout(60):
                first = json.loads(await socket.recv())
        assert first["command"] == "introspection"


def test_who_shows_a_wrong_token_or_comes_twice_gets_nothing(gate):
    gate.expect("s1", TOKEN)
    door = gate.folder / "gate.sock"
    with pytest.raises(PermissionError, match="does not know"):
        fetch_listener(door, "s1", "wrong")
    fetch_listener(door, "s1", TOKEN).close()
    with pytest.raises(PermissionError, match="does not know"):
        fetch_listener(door, "s1", TOKEN)
    gate.remove("s1")
    assert not gate.path("s1").exists()
