"""Requests that wait for a worker: their threads are free, and their answers equal all others."""

from __future__ import annotations

import asyncio
import json
from concurrent.futures import Future
from typing import Any

import pytest
from asgiref.sync import sync_to_async
from django.http import HttpResponse

from backend.core import guard
from backend.ingress import handler
from backend.ingress.handler import ThreadedHandler
from backend.workers.deferred import Deferred, Waiting
from backend.workers.errors import BusyError
from backend.workers.priorities import Pools
from tests.backend.conftest import HOST

pytestmark = pytest.mark.django_db(transaction=True)

HEAD = [
    (b"host", HOST.encode()),
    (b"cookie", f"{guard.cookie_name(HOST)}={guard.keys().cookie_value}".encode()),
]


async def ask(handling, path, *, headers=()):
    """Status, headers and body of an answer."""
    sent = []

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message):
        sent.append(message)

    address, _, query = path.partition("?")
    scope = {"type": "http", "method": "GET", "path": f"/api/v1/{address}", "query_string": query.encode()}
    await handling({**scope, "headers": [*HEAD, *headers]}, receive, send)
    start, *rest = sent
    body = b"".join(message["body"] for message in rest)
    return start["status"], {name.lower(): value for name, value in start["headers"]}, body


@pytest.fixture
def project(api):
    return api.post("projects", {"name": "Robot", "template": "laser_bump_and_go"}, expect=201)


@pytest.fixture
def one(monkeypatch):
    """A handler with one thread only."""
    monkeypatch.setitem(handler.THREADS, "local", 1)
    return ThreadedHandler()


@pytest.fixture
def held(monkeypatch):
    """Work that the test itself completes."""
    work: Future[Any] = Future()
    monkeypatch.setattr(Pools, "ask", lambda *_, **__: work)
    return work


async def test_many_requests_wait_for_workers_and_hold_no_thread(project, one, held):
    waiting = [asyncio.ensure_future(ask(one, f"projects/{project['id']}/xml")) for _ in range(20)]
    for _ in range(3):  # with a single thread
        assert (await ask(one, "projects"))[0] == 200
    assert not any(task.done() for task in waiting)
    held.set_result({"text": "<root/>"})
    for status, headers, body in await asyncio.gather(*waiting):
        assert (status, body) == (200, b"<root/>")
        assert headers[b"content-disposition"].startswith(b"attachment")
        assert headers[b"x-content-type-options"] == b"nosniff"
        assert headers[b"content-security-policy"] == b"default-src 'none'; sandbox"


async def test_a_client_that_leaves_does_not_end_the_work_of_others(project, one, held):
    path = f"projects/{project['id']}/xml"
    leaving, staying = (asyncio.ensure_future(ask(one, path)) for _ in range(2))
    await ask(one, "projects")
    leaving.cancel()
    await asyncio.wait([leaving])
    held.set_result({"text": "<root/>"})
    assert (await staying)[0] == 200


async def test_an_answer_of_a_worker_is_not_sent_again_to_who_has_it(one, project):
    path = f"projects/{project['id']}/xml"
    status, headers, body = await ask(one, path)
    assert (status, body[:5]) == (200, b"<?xml")
    again = await ask(one, path, headers=[(b"if-none-match", headers[b"etag"])])
    assert (again[0], again[2]) == (304, b"")


async def test_what_the_translator_refuses_is_a_problem_document(one, api, project):
    broken = {"path": f"trees/{project['main_tree']}.json", "base_revision": 1, "content": "{"}
    await sync_to_async(api.save)(project["id"], broken)
    status, headers, body = await ask(one, f"projects/{project['id']}/xml")
    document = json.loads(body)
    assert (status, headers[b"content-type"]) == (422, b"application/problem+json")
    assert (document["code"], document["diagnostics"][0]["severity"]) == ("check_failed", "error")


async def test_too_much_work_is_refused_with_when_to_ask_again(one, project, monkeypatch):
    def busy(*_, **__):
        raise BusyError("The server has too much to do.")

    monkeypatch.setattr(Pools, "ask", busy)
    status, headers, body = await ask(one, f"projects/{project['id']}/xml")
    assert (status, headers[b"retry-after"], json.loads(body)["code"]) == (503, b"5", "busy")
    assert (await ask(one, f"projects/{project['id']}"))[0] == 200  # the project opens without being checked


def test_a_handler_that_cannot_wait_gets_whole_answers(api, project):
    assert api.get(f"projects/{project['id']}/xml").startswith(b"<?xml")


def test_a_handler_that_cannot_wait_gets_the_answer_itself():
    class Later:
        complete = staticmethod(lambda _: HttpResponse(b"done"))

    later: Any = type("Later", (Deferred,), {"__init__": lambda self: None, "complete": Later.complete})()
    request: Any = type("Request", (), {})()
    assert Waiting(lambda _: later)(request).getvalue() == b"done"
    request.handler_waits = True
    assert Waiting(lambda _: later)(request) is later
