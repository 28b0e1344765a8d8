"""Sockets behind a real server, and an editor that opens one."""

from __future__ import annotations

import asyncio
import contextlib
import json
import threading

import pytest
import uvicorn
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from backend.config import asgi
from backend.config.server import bind
from backend.core import guard
from tests.backend.accounts.conftest import person, stranger, team

GO = "file:///project/actions/Go.py"
SOURCE = """import py_trees
from geometry_msgs.msg import Twist
from tree_gardener.ports import Port
from Turn import Turn


class Go(py_trees.behaviour.Behaviour):
    def update(self):
        twist = Twist()
        twist.linear.x = 1.0
        return py_trees.common.Status.SUCCESS
"""


@pytest.fixture
def host(settings_of, tmp_path):
    """The sockets behind a real server; its address as a `Host`."""
    settings_of(data_dir=tmp_path)
    listener = bind("127.0.0.1", 0)
    config = uvicorn.Config(asgi.sockets, ws="websockets-sansio", lifespan="off", log_config=None)
    server = uvicorn.Server(config)
    thread = threading.Thread(target=lambda: asyncio.run(server.serve(sockets=[listener])))
    thread.start()
    yield f"127.0.0.1:{listener.getsockname()[1]}"
    server.should_exit = True
    thread.join()


@pytest.fixture
def limits(settings_of, tmp_path):
    """Sets limits, and keeps the data folder of the test."""
    return lambda **values: settings_of(data_dir=tmp_path, **values)


CONTENT_MODIFIED = -32801
"""The error code of an answer that a change of a file made useless: the question is asked again."""


class Page:
    """The editor's side of the socket."""

    def __init__(self, socket):
        self.socket = socket
        self.last = 0
        self.told = []

    def notify(self, method, **params):
        self.socket.send(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}))

    def ask(self, method, **params):
        while True:
            answer = self._ask_once(method, params)
            if answer.get("error", {}).get("code") != CONTENT_MODIFIED:
                return answer.get("result", answer.get("error"))

    def _ask_once(self, method, params):
        self.last += 1
        message = {"jsonrpc": "2.0", "id": self.last, "method": method, "params": params}
        self.socket.send(json.dumps(message))
        while True:
            answer = json.loads(self.socket.recv(timeout=60))
            if answer.get("id") == self.last:
                return answer
            self.told.append(answer)

    def begin(self):
        self.ask("initialize", rootUri="file:///project", capabilities={})
        self.notify("initialized")

    def open(self, uri, text):
        document = {"uri": uri, "languageId": "python", "version": 1, "text": text}
        self.notify("textDocument/didOpen", textDocument=document)

    def at(self, method, line, character, **more):
        return self.ask(
            f"textDocument/{method}",
            textDocument={"uri": GO},
            position={"line": line, "character": character},
            **more,
        )

    def ended(self):
        """Returns the close code, after any other messages."""
        try:
            while True:
                self.socket.recv(timeout=60)
        except ConnectionClosed as closed:
            return closed.rcvd.code


@contextlib.contextmanager
def opened(host, path, **changes):
    headers = {"Cookie": f"{guard.cookie_name(host)}={guard.keys().cookie_value}"}
    options = {"origin": f"http://{host}", "additional_headers": headers, "proxy": None}
    with connect(f"ws://{host}{path}", **options | changes) as socket:
        yield Page(socket)


@pytest.fixture
def with_actions(api, project):
    turn = "class Turn:\n    angle = 0.5\n"
    api.save(
        project["id"],
        {"path": "actions/Go.py", "base_revision": 0, "content": SOURCE},
        {"path": "actions/Turn.py", "base_revision": 0, "content": turn},
    )
    return project["id"]


__all__ = ["person", "stranger", "team"]
