"""The application that a server runs."""

from __future__ import annotations

from typing import Any

from backend.config import asgi


async def test_a_request_goes_through_the_guard():
    sent = []

    async def receive():
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message):
        sent.append(message)

    scope: Any = {
        "type": "http",
        "method": "GET",
        "path": "/health/live",
        "raw_path": b"/health/live",
        "query_string": b"",
        "scheme": "http",
        "client": ("127.0.0.1", 5),
        "headers": [(b"host", b"127.0.0.1:8000")],
    }
    await asgi.application(scope, receive, send)
    assert sent[0]["status"] == 200
