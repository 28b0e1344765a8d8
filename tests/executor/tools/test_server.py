"""A user's tools at their socket: ruff, and a language server for each editor."""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import json
import os
import socket
import sys
from pathlib import Path

import psutil
import pytest
from websockets.asyncio.client import unix_connect
from websockets.exceptions import InvalidStatus

from executor.tools import language
from executor.tools.checker import run_ruff
from executor.tools.server import ToolsServer

TOKEN = "secret"
FAKE = Path(__file__).parents[2] / "fakes" / "language_server.py"


@contextlib.asynccontextmanager
async def tools(tmp_path, *, grace_s=60.0):
    path = str(tmp_path / "s")
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(path)
    listener.listen()
    server = ToolsServer(listener, TOKEN, grace_s=grace_s)
    running = asyncio.create_task(server.run())
    try:
        yield path, running
    finally:
        server.end()
        await running
        listener.close()


def client(path, target, token=TOKEN):
    headers = {"Authorization": f"Bearer {token}"}
    return unix_connect(path, f"ws://localhost/{target}", additional_headers=headers, compression=None)


def texts_below(folder):
    return [path.read_text() for path in folder.rglob("*") if path.is_file()]


def children():
    return [child.name() for child in psutil.Process().children(recursive=True)]


async def test_ruff_answers_about_a_text(tmp_path):
    async with tools(tmp_path) as (path, _), client(path, "ruff") as socket_:
        arguments = ["format", "--isolated", "--no-cache", "-"]
        await socket_.send(json.dumps({"arguments": arguments, "source": "x = {  'é':1 }\n"}))
        assert json.loads(await socket_.recv()) == {"status": 0, "output": 'x = {"é": 1}\n'}


async def test_a_checker_that_hangs_is_given_up(tmp_path, monkeypatch):
    monkeypatch.setattr("executor.tools.checker.TIMEOUT_S", 0.2)
    assert (await run_ruff(["60"], "", program="/bin/sleep"))["status"] is None


async def test_only_clients_with_the_token_are_served(tmp_path):
    async with tools(tmp_path) as (path, _):
        for target, token, status in (("ruff", "wrong", 401), ("other", TOKEN, 404)):
            with pytest.raises(InvalidStatus, match=str(status)):
                await client(path, target, token)


async def test_they_end_without_clients(tmp_path):
    async with tools(tmp_path, grace_s=0.3) as (path, running):
        async with client(path, "language"):
            await asyncio.sleep(0.6)  # the time is the test: twice the grace period
            assert not running.done()
        await asyncio.wait_for(running, 30)


async def test_an_editor_has_files_bytes_and_a_folder_that_goes(tmp_path, monkeypatch):
    monkeypatch.setattr(language.serve_editor, "__defaults__", (("/bin/cat",),))
    async with tools(tmp_path) as (path, _), client(path, "language") as editor:
        told = json.loads(await editor.recv())
        home = Path(told["home"])
        assert told["python"] == sys.executable
        await editor.send(json.dumps({"files": {"a/b.py": "1", "c.py": "2"}}))
        await editor.send(json.dumps({"files": {"c.py": None, "a/b.py": "3"}}))
        await editor.send(json.dumps({"source": f"{home}/c.py"}))
        await editor.send(json.dumps({"source": os.__file__}))
        await editor.send(b"hello")
        said = b""
        memory = None
        sources = {}
        while said != b"hello" or memory is None:
            message = await editor.recv()
            if isinstance(message, bytes):
                said += message
            elif "source" in (heard := json.loads(message)):
                sources[heard["source"]] = heard["text"]
            else:
                memory = heard["memory_bytes"]
        assert sources == {f"{home}/c.py": None, os.__file__: inspect.getsource(os)}
        assert memory > 1e5
        assert texts_below(home) == ["3"]
        assert "cat" in children()
    assert texts_below(home) == []
    assert "cat" not in children()


async def test_a_language_server_that_dies_ends_the_socket(tmp_path, monkeypatch):
    monkeypatch.setattr(language.serve_editor, "__defaults__", ((sys.executable, str(FAKE), "dies"),))
    async with tools(tmp_path) as (path, _), client(path, "language") as editor:
        await editor.recv()
        await editor.send(json.dumps({"files": {}}))
        await editor.send(b"Content-Length: 2\r\n\r\n{}")
        await asyncio.wait_for(editor.wait_closed(), 30)
