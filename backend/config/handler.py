"""Django for HTTP, each request from beginning to end in one of a few threads that stay.

Django's own ASGI handler makes a thread for each request and changes between it and the event loop several
times, although no view here is asynchronous. That cost more than most of the answers.
"""

from __future__ import annotations

import asyncio
import contextvars
from functools import partial
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from django.core import signals
from django.core.exceptions import RequestAborted
from django.core.handlers.asgi import ASGIHandler, get_script_prefix
from django.core.handlers.base import BaseHandler
from django.urls import set_script_prefix

from backend.config.environment import environment
from backend.config.threads import Threads

if TYPE_CHECKING:
    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, HTTPScope

THREADS: Final = {"local": 8, "team": 8}
"""By mode; each has a connection to the database."""


class Answer(NamedTuple):
    """A response that needs its thread no longer."""

    status: int
    headers: list[tuple[bytes, bytes]]
    body: bytes


class ThreadedHandler(ASGIHandler):
    """Django as an ASGI application for HTTP alone."""

    def __init__(self) -> None:
        BaseHandler.__init__(self)  # ASGIHandler would load the middleware for the event loop
        self.load_middleware(is_async=False)
        self._threads = Threads(THREADS[environment().mode], "http")

    async def __call__(self, scope: HTTPScope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:  # type: ignore[override]
        """Reads the request, has a thread answer it, and sends the answer."""
        try:
            body = await self.read_body(receive)
        except RequestAborted:
            return
        # What a request sets for itself (language, address) must not stay with the thread.
        context = contextvars.copy_context()
        work = partial(context.run, self._answer, scope, body)
        answer: Answer = await self._threads.run(asyncio.get_running_loop(), work)
        await send(
            {
                "type": "http.response.start",
                "status": answer.status,
                "headers": answer.headers,
                "trailers": False,
            }
        )
        await send({"type": "http.response.body", "body": answer.body, "more_body": False})

    def _answer(self, scope: HTTPScope, body: IO[bytes]) -> Answer:
        set_script_prefix(get_script_prefix(scope))
        signals.request_started.send(sender=type(self), scope=scope)
        with body:
            request, refused = self.create_request(scope, body)
            response: Any = refused if request is None else self.get_response(request)
            try:
                return Answer(response.status_code, _headers(response), response.getvalue())
            finally:
                response.close()


def _headers(response: Any) -> list[tuple[bytes, bytes]]:
    pairs = [(name.encode("ascii"), value.encode("latin-1")) for name, value in response.items()]
    cookies = (cookie.output(header="").strip() for cookie in response.cookies.values())
    return pairs + [(b"Set-Cookie", cookie.encode("ascii")) for cookie in cookies]
