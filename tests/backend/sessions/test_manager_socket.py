"""Sockets to a session's manager."""

from __future__ import annotations

from uuid import uuid4

import pytest
from websockets.asyncio.server import serve, unix_serve

from backend.sessions import writes
from backend.sessions.manager_socket import manager_socket
from backend.sessions.models import Session


@pytest.mark.parametrize("kind", ["tcp", "unix"])
async def test_the_manager_is_reached_with_its_token(kind: str, tmp_path) -> None:
    seen = []

    async def answer(socket) -> None:
        seen.append((socket.request.path, socket.request.headers["Authorization"]))
        await socket.send("hello")

    path = str(tmp_path / "s")
    server = serve(answer, "127.0.0.1", 0) if kind == "tcp" else unix_serve(answer, path)
    async with server as served:
        address = f"unix:{path}"
        if kind == "tcp":
            address = f"127.0.0.1:{next(iter(served.sockets)).getsockname()[1]}"
        session = Session(id=uuid4(), address=address)
        async with manager_socket(session, "control") as socket:
            assert await socket.recv() == "hello"
    assert seen == [("/control", f"Bearer {writes.manager_token(session)}")]
