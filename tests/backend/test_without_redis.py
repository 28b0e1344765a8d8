"""A team server whose Redis ends works on without notices, and delivers them again when it is back."""

from __future__ import annotations

import json
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

import pytest
import requests
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.backend.config.test_web_workers import until
from tests.backend.programs import sign_in
from tests.backend.services import redis_server
from tests.backend.serving import TIMEOUT_S, serving
from tests.backend.sessions.keeper.conftest import Host
from tests.benchmarks.load import settings_of

pytestmark = [pytest.mark.kills, pytest.mark.timeout(300)]
TRY_AGAIN_LATER = 1013
SAVES = 3


class Team:
    """A server with PostgreSQL, Redis and a keeper, and an account that is signed in."""

    def __init__(self, stack: ExitStack, folder: Path, database_url: str):
        self.redis = stack.enter_context(redis_server())
        self.log = folder / "log"
        host = Host(folder, "manager", 2, patience_s=60)
        stack.callback(host.close)
        services = {
            "BT_STUDIO_DATABASE_URL": database_url,
            "BT_STUDIO_REDIS_URL": self.redis.url,
            "BT_STUDIO_LAUNCHER": "docker",
            "BT_STUDIO_KEEPER_FOLDER": str(host.folder),
        }
        settings, _ = settings_of(services)
        log = stack.enter_context(self.log.open("w"))
        self.base = stack.enter_context(serving(folder, log=log, **settings)).base
        ((_, self._cookie),) = sign_in(folder, settings, 1)

    def call(self, method, path, body=None):
        headers = {"Origin": self.base, "Cookie": self._cookie}
        answer = requests.request(
            method, f"{self.base}/api/v1/{path}", json=body, headers=headers, timeout=TIMEOUT_S
        )
        assert answer.ok, answer.text
        return answer.json()

    def socket(self, path):
        headers = {"Cookie": self._cookie, "Origin": self.base}
        address = f"ws{self.base.removeprefix('http')}/ws/{path}"
        return connect(address, additional_headers=headers, proxy=None, open_timeout=TIMEOUT_S)

    def save(self, project, revision):
        """Makes the next revision of a project's only file."""
        file = {"path": "a.txt", "base_revision": revision, "content": f"after {revision}"}
        return self.call("POST", f"projects/{project}/changes", {"files": [file]})["revision"]

    def lines(self, text):
        """The lines of the log that contain a text."""
        return [line for line in self.log.read_text().splitlines() if text in line]


@pytest.fixture
def team(database_url):
    with tempfile.TemporaryDirectory() as name, ExitStack() as stack:  # the path of a socket is short
        yield Team(stack, Path(name), database_url)


def told(socket):
    return json.loads(socket.recv(timeout=TIMEOUT_S))["revision"]


def answers(control):
    """Whether a session's socket carries messages both ways."""
    control.send(json.dumps({"id": "p", "command": "ping", "data": {}}))
    while (message := json.loads(control.recv(timeout=TIMEOUT_S)))["id"] != "p":
        pass
    return message["command"] == "ack"


def reopened(stack, team, path):
    """Opens a socket of notices as a page does: again, as long as the server asks to try later."""
    deadline, code = time.monotonic() + TIMEOUT_S, TRY_AGAIN_LATER
    while code == TRY_AGAIN_LATER and time.monotonic() < deadline:
        socket = stack.enter_context(team.socket(path))
        try:
            return socket, told(socket)
        except ConnectionClosed as closed:
            code = closed.rcvd.code
        time.sleep(0.2)
    raise AssertionError(f"the socket was closed with {code}")


def test_a_server_works_without_redis_and_tells_of_saves_again_when_it_is_back(team):
    project = team.call("POST", "projects", {"name": "Kept"})["id"]
    session = team.call("POST", f"projects/{project}/session")["id"]
    notices, control = f"projects/{project}/notices", f"sessions/{session}/control"
    with team.socket(notices) as before, team.socket(control) as old_control:
        assert told(before) == 1
        revision = team.save(project, 0)
        assert told(before) == revision
        assert answers(old_control)

        team.redis.end()
        for _ in range(SAVES):
            revision = team.save(project, revision)
        assert team.call("GET", f"projects/{project}")["revision"] == revision
        with team.socket(control) as new_control:
            assert answers(new_control)
            assert answers(old_control)
        with team.socket(notices) as refused, pytest.raises(ConnectionClosed) as closed:
            told(refused)
        assert closed.value.rcvd.code == TRY_AGAIN_LATER
        assert len(team.lines("a notice was not sent")) == SAVES
        until(lambda: team.lines("Redis does not answer, and is asked again each second"))
        assert not team.lines("Traceback")

        team.redis.start()
        with ExitStack() as stack:
            after, newest = reopened(stack, team, notices)
            assert newest == revision
            revision = team.save(project, revision)
            assert told(after) == revision
            assert told(before) == revision, "a socket that was open all the time receives notices again"
    assert not team.lines("Traceback")
