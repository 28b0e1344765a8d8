"""HTTP by a fixed pool of threads: requests, answers, and data that must not stay with a thread."""

from __future__ import annotations

import asyncio
from typing import Any

from django.http import HttpResponse
from django.utils import translation

from backend.core import guard
from backend.ingress import handler
from backend.ingress.handler import ThreadedHandler
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
