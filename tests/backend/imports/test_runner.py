"""The child of an import ends with its client, and reads nothing for a server that has no place for it."""

from __future__ import annotations

import asyncio
import io
import json
import os
from typing import Any

import psutil
import pytest
from asgiref.sync import sync_to_async

from backend.config import asgi
from backend.core import guard
from backend.core.processes.stops import Stop, StoppedError
from backend.imports.errors import ImportUnavailableError
from backend.imports.runner import COPY_BYTES, run_beside, runner
from tests.backend.accounts.conftest import person, stranger, team  # noqa: F401
from tests.backend.conftest import HOST

SLOW = b'<robot name="r" xmlns:xacro="http://x"><link name="${sum(1 for i in range(10**9))}"/></robot>'
HEADER = {"filename": "r.xacro", "kind": "", "main": "", "name": "", "arguments": {}, "simplify": False}
HEAD = [
    (b"host", HOST.encode()),
    (b"cookie", f"{guard.cookie_name(HOST)}={guard.keys().cookie_value}".encode()),
    (b"content-type", b"application/octet-stream"),
    (b"content-length", str(len(SLOW)).encode()),
]


def children(name):
    """Processes of a module below this one."""
    found = []
    for child in psutil.Process().children(recursive=True):
        try:
            if name in child.cmdline():
                found.append(child)
        except psutil.Error:
            continue
    return found


@pytest.mark.django_db(transaction=True)
async def test_a_client_that_leaves_ends_the_child_and_nothing_is_written(api):
    project = await sync_to_async(api.post)("projects", {"name": "Robot"}, expect=201)
    sent: list[Any] = []
    bodies = [{"type": "http.request", "body": SLOW, "more_body": False}]

    async def receive():
        if bodies:
            return bodies.pop()
        while not children("executor.expansion"):  # noqa: ASYNC110 - a process gives no event
            await asyncio.sleep(0.02)
        return {"type": "http.disconnect"}

    async def send(message):
        sent.append(message)

    scope: Any = {"type": "http", "method": "POST", "path": f"/api/v1/projects/{project['id']}/imports"}
    scope |= {"query_string": b"kind=robot&filename=r.xacro", "headers": HEAD}
    await asgi.requests(scope, receive, send)
    assert sent == []
    assert [*children("executor.uploads"), *children("executor.expansion")] == []
    assert (await sync_to_async(api.get)(f"projects/{project['id']}"))["revision"] == 1


def test_work_of_a_client_that_has_left_does_not_begin():
    stop = Stop()
    stop.set()
    with pytest.raises(StoppedError):
        run_beside(HEADER, io.BytesIO(SLOW), stop)
    assert children("executor.uploads") == []


def test_a_child_is_released_before_its_number_is_free(monkeypatch):
    """A client may leave while the answer is read: the number may be that of another process by then."""
    stop, signalled = Stop(), []
    run_beside(HEADER, io.BytesIO(b"<robot/>"), stop)
    monkeypatch.setattr(os, "killpg", lambda *given: signalled.append(given))
    stop.set()
    assert signalled == []


def test_a_child_without_an_answer_is_logged_with_what_it_said(caplog):
    broken = {"filename": 1}
    assert run_beside(broken, io.BytesIO(b"x"), Stop()) != b""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("backend.imports.runner.CHILD", "executor.uploads.none")
        assert run_beside(HEADER, io.BytesIO(b"x"), Stop()) == b""
    assert "No module named executor.uploads.none" in caplog.text
    assert "status 1" in caplog.text


class Tools:
    """A user's tools; they leave before they answer, if nothing is to be answered."""

    def __init__(self, answer):
        self.answer, self.heard = answer, []

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return None

    def close(self):
        """Does nothing."""

    def send(self, message):
        self.heard.append(list(message))

    def recv(self, timeout):
        if self.answer is None:
            raise ConnectionResetError
        return self.answer


def test_an_upload_goes_to_the_tools_in_parts_and_once(user, settings_of, monkeypatch):
    settings_of(launcher="docker")
    monkeypatch.setattr("backend.language.tools.address_of", lambda *_, **__: "unix:/none")
    data = bytes(range(256)) * 10_000
    leaving, fine = Tools(None), Tools(b"{}")
    reached = [OSError(), leaving, OSError(), fine]

    def reach(*_given, **_options):
        found = reached.pop(0)
        if isinstance(found, OSError):
            raise found
        return found

    monkeypatch.setattr("backend.language.tools.open_sync_socket", reach)
    with pytest.raises(ImportUnavailableError):
        runner(user)(HEADER, io.BytesIO(data), Stop())
    assert runner(user)(HEADER, io.BytesIO(data), Stop()) == b"{}"
    assert reached == []
    for [parts] in (leaving.heard, fine.heard):
        assert b"".join(parts) == json.dumps(HEADER).encode() + b"\n" + data
        assert max(map(len, parts)) <= COPY_BYTES < len(data)


def test_a_team_imports_in_containers_or_not_at_all(team, settings_of, person):  # noqa: F811
    ada = person("ada").user
    with pytest.raises(ImportUnavailableError):
        runner(ada)
    settings_of(launcher="docker")
    assert runner(ada) is not run_beside


def test_on_this_machine_it_is_a_child_process(user):
    assert runner(user) is run_beside
