"""Sockets to a session's manager."""

from __future__ import annotations

from types import SimpleNamespace
from uuid import uuid4

import pytest
from websockets.asyncio.server import serve, unix_serve

from backend.accounts.models import User
from backend.sessions.lifecycle import writes
from backend.sessions.manager.sockets import USER_HEADER, manager_socket
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


@pytest.mark.parametrize(
    ("is_team", "full_name", "header"),
    [(True, "Jürgen O'Neil", "J%C3%BCrgen%20O%27Neil"), (True, "", "ada"), (False, "", "")],
)
async def test_the_manager_receives_the_name_of_the_user(
    is_team: bool, full_name: str, header: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []

    async def answer(socket) -> None:
        seen.append((socket.request.path, socket.request.headers[USER_HEADER]))
        await socket.send("hello")

    mode = SimpleNamespace(is_team=is_team)
    monkeypatch.setattr("backend.sessions.manager.sockets.environment", lambda: mode)
    async with serve(answer, "127.0.0.1", 0) as served:
        address = f"127.0.0.1:{next(iter(served.sockets)).getsockname()[1]}"
        user = User(username="ada", first_name=full_name)
        async with manager_socket(Session(id=uuid4(), address=address), "control?user=bob", user) as socket:
            assert await socket.recv() == "hello"
    assert seen == [("/control?user=bob", header)]
