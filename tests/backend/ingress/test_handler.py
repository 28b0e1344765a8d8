"""HTTP by a fixed pool of threads: requests, answers, and data that must not stay with a thread."""

from __future__ import annotations

import asyncio
import gc
import threading
import weakref
from concurrent.futures import Future
from typing import Any

import pytest
from django.http import HttpResponse
from django.utils import translation

from backend.core import guard
from backend.core.readers import readers, reserve
from backend.core.tasks import ended
from backend.ingress import handler
from backend.ingress.handler import ThreadedHandler
from backend.workers.deferred import Deferred
from tests.backend.conftest import HOST

HEAD = [(b"host", HOST.encode()), (b"authorization", f"Bearer {guard.keys().token}".encode())]


def ask(*messages, handling=None, **scope):
    """Returns the messages that an ASGI server would send for these messages of a client."""
    sent, waiting = [], list(messages)

    async def receive():
        return waiting.pop(0)

    async def send(message):
        sent.append(message)

    full: Any = {"type": "http", "method": "GET", "path": "/", "query_string": b"", "headers": HEAD} | scope
    asyncio.run((handling or ThreadedHandler())(full, receive, send))
    return sent


def body(data, *, more=False):
    return {"type": "http.request", "body": data, "more_body": more}


def test_an_answer_has_its_status_headers_and_cookies():
    link = f"token={guard.keys().token}".encode()
    start, end = ask(body(b""), query_string=link)
    headers = dict(start["headers"])
    assert (start["status"], headers[b"Location"]) == (302, b"/")
    assert guard.cookie_name(HOST).encode() in headers[b"Set-Cookie"]
    assert end == {"type": "http.response.body", "body": b"", "more_body": False}


def test_a_body_that_comes_in_parts_is_one(monkeypatch):
    handling = ThreadedHandler()
    monkeypatch.setattr(handling, "get_response", lambda request: HttpResponse(request.body[::-1]))
    parts = [body(b"1234", more=True), body(b"56789")]
    start, end = ask(*parts, handling=handling, method="POST")
    assert (start["status"], end["body"]) == (200, b"987654321")


def test_a_client_that_leaves_before_its_request_is_whole_is_not_answered():
    assert ask(body(b"{", more=True), {"type": "http.disconnect"}, method="POST") == []


def test_what_a_request_sets_for_itself_does_not_stay_with_the_thread(monkeypatch):
    monkeypatch.setitem(handler.THREADS, "local", 1)
    handling, spoken = ThreadedHandler(), []
    answer = handling.get_response

    def speaking(request):
        spoken.append(translation.get_language())
        translation.activate("es")
        return answer(request)

    monkeypatch.setattr(handling, "get_response", speaking)
    for _ in range(2):
        ask(body(b""), handling=handling)
    assert spoken == ["en", "en"]


async def unread(handling, *, method="GET", size):
    """Asks for an answer and reads nothing of its body; returns its status and the task that sends it."""
    status = asyncio.get_running_loop().create_future()

    async def receive():
        return body(b"")

    async def send(message):
        if message["type"] == "http.response.start":
            status.set_result(message["status"])
        elif len(message["body"]) >= size:
            await asyncio.Event().wait()

    scope: Any = {"type": "http", "method": method, "path": "/", "query_string": b"", "headers": HEAD}
    task = asyncio.create_task(handling(scope, receive, send))
    return await status, task


def test_answers_that_nobody_reads_are_bounded_and_those_to_writes_are_not_refused(monkeypatch, settings_of):
    settings_of(max_unread_bytes=250_000)
    handling = ThreadedHandler()
    monkeypatch.setattr(handling, "get_response", lambda _: HttpResponse(bytes(100_000)))

    async def asked():
        found = [await unread(handling, size=100_000) for _ in range(2)]
        found += [await unread(handling, size=100_000, method=method) for method in ("GET", "POST")]
        assert readers().total == 300_000
        monkeypatch.setattr(handling, "get_response", lambda _: HttpResponse(bytes(1000)))
        found += [await unread(handling, size=100_000)]
        await ended(*(task for _, task in found))
        return [status for status, _ in found]

    assert asyncio.run(asked()) == [200, 200, 503, 200, 200]
    assert readers().total == 0


def test_what_is_fetched_for_an_answer_counts_until_it_has_arrived(monkeypatch, settings_of):
    settings_of(max_unread_bytes=250_000)
    handling = ThreadedHandler()

    def fetching(_request):
        reserve(200_000)
        return HttpResponse(bytes(70_000))

    async def asked():
        monkeypatch.setattr(handling, "get_response", fetching)
        first, one = await unread(handling, size=70_000)
        assert readers().total == 70_000
        monkeypatch.setattr(handling, "get_response", lambda _: reserve(10**9) or HttpResponse())
        one.cancel()
        second, other = await unread(handling, size=1)
        await ended(one, other)
        return first, second

    assert asyncio.run(asked()) == (200, 200)
    assert readers().total == 0


def test_ending_the_work_of_a_client_that_has_left_may_wait_without_the_event_loop(monkeypatch):
    handling, ended_in = ThreadedHandler(), []
    work: Future[None] = Future()

    def cancel():
        ended_in.append(threading.current_thread())
        work.set_result(None)

    view: Any = None
    deferred = Deferred(view, view, work, lambda done: done.result(), cancel=cancel)
    monkeypatch.setattr(handling, "get_response", lambda _: deferred)
    assert ask(body(b""), {"type": "http.disconnect"}, handling=handling) == []
    [thread] = ended_in
    assert thread is not threading.current_thread()


@pytest.mark.django_db(transaction=True)
def test_nothing_of_an_answer_stays_until_the_garbage_collector_comes(api, project, monkeypatch):
    handling, kept = ThreadedHandler(), []
    respond = handling.get_response

    def noted(request):
        response = respond(request)
        kept.append(weakref.ref(response))
        return response

    monkeypatch.setattr(handling, "get_response", noted)
    gc.collect()
    gc.disable()
    try:
        start, end = ask(body(b""), handling=handling, path=f"/api/v1/projects/{project['id']}/revisions")
        assert (start["status"], end["more_body"]) == (200, False)
        assert [one() for one in kept] == [None]
    finally:
        gc.enable()
