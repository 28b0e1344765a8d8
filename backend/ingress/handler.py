"""Runs Django for HTTP; one thread of a fixed pool handles each request from beginning to end.

Django's ASGI handler makes a thread for each request, and switches several times between the thread and the
event loop, although no view of this server is asynchronous. That took longer than most views.
"""

from __future__ import annotations

import asyncio
import contextvars
import os
import time
from contextlib import asynccontextmanager, suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from django.core import signals
from django.core.handlers.asgi import ASGIHandler, get_script_prefix
from django.core.handlers.base import BaseHandler
from django.middleware.http import ConditionalGetMiddleware
from django.urls import set_script_prefix

from backend.config.environment import environment
from backend.core.connection_costs import known
from backend.core.file_answers import PART, FileAnswer
from backend.core.problems import problem, problem_response
from backend.core.processes.siblings import siblings
from backend.core.processes.threads import Threads
from backend.core.scratch import scratch
from backend.ingress.bodies import BODY, PATIENCE_S, SLOWEST, Bodies, BodyRefusedError, ClientLeftError
from backend.ingress.middleware import secured
from backend.ingress.owners import owner_of
from backend.ingress.turns import turns
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable
    from concurrent.futures import Future

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, HTTPScope
    from django.http import HttpRequest

    from backend.ingress.bodies import Refused, Upload

THREADS: Final = {"local": 8, "team": 8}
"""Number of request threads, by mode; each has a connection to the database."""
THREADS_OF_SEVERAL: Final = 4
"""Number of request threads of each worker, if there are several workers."""
OWNERS_SHARE: Final = 4
"""One owner (a user, or all others with one address) may use one thread in four, if there are accounts."""
HASHING: Final = ("/accounts/", "/admin/")
"""Paths that receive passwords; hashing a password takes a third of a second of processor time."""
MOST_WAITING: Final = 600
RETRY_S: Final = 30
LOOP_S: Final = 0.0005
"""Event-loop time in seconds for one request, as measured."""
LINGER_S: Final = 10.0
LINGER_BYTES: Final = 64 * 1024 * 1024
"""`LINGER_S` and `LINGER_BYTES`: seconds and bytes for which a refused body is still read and discarded."""


class Answer(NamedTuple):
    """A response that no longer needs a thread."""

    status: int
    headers: list[tuple[bytes, bytes]]
    body: bytes
    file: IO[bytes] | None = None
    """The body, if it is too large for the memory."""


class Unfinished(NamedTuple):
    """A response that waits for a worker, and needs no thread until then."""

    request: HttpRequest
    response: Deferred


class ThreadedHandler(ASGIHandler):
    """Django as an ASGI application for HTTP only.

    Args:
        upload: the route for archives, if there is one.
        hashing: the number of passwords that are hashed at the same time; the default depends on the machine.
    """

    def __init__(self, upload: Upload | None = None, *, hashing: int | None = None) -> None:
        BaseHandler.__init__(self)  # ASGIHandler would load the middleware for the event loop
        self.load_middleware(is_async=False)
        family = siblings.family
        size = family.size if family else 1
        threads = THREADS_OF_SEVERAL if family else THREADS[environment().mode]
        share = threads // OWNERS_SHARE if environment().is_team else None
        self.threads = Threads(threads, "http", per_owner=share)
        share_of_processors = max(1 if family else 2, (os.cpu_count() or 1) // (2 * size))
        self._hashing = asyncio.Semaphore(hashing or share_of_processors)
        self._waiting, self._most_waiting = 0, MOST_WAITING // size
        self._bodies = Bodies(self.threads, upload, scratch())

    async def __call__(self, scope: HTTPScope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:  # type: ignore[override]
        """Reads the request, answers it in a thread, and sends the answer."""
        owner = owner_of(scope)
        known(scope, owner)
        turns.spend(owner, LOOP_S)
        try:
            async with self._bodies.read(scope, receive, owner) as body:
                # Context variables of a request (language, address) must not stay set in the thread.
                context = contextvars.copy_context()
                work = partial(context.run, self._answer, scope, body.file)
                async with self._turn(scope) as has_turn:
                    answer = await self._answered(work, None if has_turn else owner)
                while isinstance(answer, Unfinished):
                    await _ended(answer.response.work)
                    answer = await self._answered(partial(context.run, self._complete, answer), owner)
        except ClientLeftError:
            return
        except BodyRefusedError as error:
            await _send_and_close(_refusal(scope, error.refused), receive, send)
            return
        if answer.file is not None:
            await self._send_file(answer, answer.file, send)
        else:
            await (_send(answer, send) if body.is_whole else _send_and_close(answer, receive, send))

    async def _send_file(self, answer: Answer, file: IO[bytes], send: ASGISendCallable) -> None:
        """Sends a file as fast as the client reads; closes the connection of a client that reads nothing."""
        with file:
            await _send(answer, send, last=False)
            while part := await self._bodies.write(partial(file.read, PART)):
                async with asyncio.timeout(PATIENCE_S + PART / SLOWEST):
                    await send({"type": "http.response.body", "body": part, "more_body": True})
            await send({"type": "http.response.body", "body": b"", "more_body": False})

    @asynccontextmanager
    async def _turn(self, scope: HTTPScope) -> AsyncIterator[bool]:
        """Limits how many passwords are hashed at the same time; yields whether this request hashes one.

        The wait holds no thread, so that sign-ins do not delay other requests.
        """
        if scope["method"] != "POST" or not scope["path"].startswith(HASHING):
            yield False
            return
        if self._waiting >= self._most_waiting:
            sentence = "Too many people sign in at this moment."
            document = problem(503, "busy", detail=sentence, hint="Try again in a minute.")
            raise BodyRefusedError(document, retry_s=RETRY_S)
        self._waiting += 1
        try:
            async with self._hashing:
                yield True
        finally:
            self._waiting -= 1

    async def _answered(
        self, work: Callable[[], Answer | Unfinished], owner: str | None
    ) -> Answer | Unfinished:
        loop = asyncio.get_running_loop()
        answer: Answer | Unfinished
        if owner is None:
            answer, _ = await self.threads.run(loop, partial(_timed, work))
            return answer
        async with turns.turn(owner):
            answer, used_s = await self.threads.run(loop, partial(_timed, work), owner)
            turns.spend(owner, used_s)
            return answer

    def _answer(self, scope: HTTPScope, body: IO[bytes]) -> Answer | Unfinished:
        set_script_prefix(get_script_prefix(scope))
        scope[BODY] = body  # type: ignore[typeddict-unknown-key]
        _tell_length(scope, body)
        signals.request_started.send(sender=type(self), scope=scope)
        request, refused = self.create_request(scope, body)
        if request is None:
            return _closed(refused)
        request.handler_waits = True  # type: ignore[attr-defined]
        return self._taken(request, self.get_response(request))

    def _complete(self, unfinished: Unfinished) -> Answer | Unfinished:
        """Completes a deferred response, with the middleware that follows the view."""
        request, deferred = unfinished
        signals.request_started.send(sender=type(self), scope=getattr(request, "scope", None))
        return self._taken(request, ConditionalGetMiddleware(lambda _: deferred.complete())(request))

    def _taken(self, request: HttpRequest, response: Any) -> Answer | Unfinished:
        if isinstance(response, Deferred):
            response.rest()
            return Unfinished(request, response)
        if isinstance(response, FileAnswer):
            file = response.take()
            response.close()
            return Answer(response.status_code, _headers(response), b"", file)
        return _closed(response)


def _timed(work: Callable[[], Answer | Unfinished]) -> tuple[Answer | Unfinished, float]:
    """Runs the work; returns its result, and the processor time that it took in seconds."""
    began_s = time.thread_time()
    return work(), time.thread_time() - began_s


async def _ended(work: Future[Any]) -> None:
    """Waits until the work has succeeded or failed; several callers may wait for the same work."""
    waiting = asyncio.wrap_future(work)
    await asyncio.wait([waiting])
    waiting.exception()  # marks the exception as retrieved; the caller gets it from `work`


def _closed(response: Any) -> Answer:
    try:
        return Answer(response.status_code, _headers(response), response.getvalue())
    finally:
        response.close()


def _tell_length(scope: HTTPScope, body: IO[bytes]) -> None:
    """Sets the length of a body that was sent in chunks. Without a length, Django's parsers read no body."""
    if any(name == b"transfer-encoding" for name, _ in scope["headers"]):
        kept = [row for row in scope["headers"] if row[0] not in {b"transfer-encoding", b"content-length"}]
        size = body.seek(0, os.SEEK_END)
        body.seek(0)
        scope["headers"] = [*kept, (b"content-length", str(size).encode())]


async def _send(answer: Answer, send: ASGISendCallable, *, last: bool = True) -> None:
    start = {"status": answer.status, "headers": answer.headers, "trailers": False}
    await send({"type": "http.response.start"} | start)  # type: ignore[arg-type]
    await send({"type": "http.response.body", "body": answer.body, "more_body": not last})


def _refusal(scope: HTTPScope, refused: Refused) -> Answer:
    response = problem_response(refused.document, refused.headers)
    secured(scope["path"], response)
    return Answer(response.status_code, _headers(response), response.content)


async def _send_and_close(answer: Answer, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:
    """Answers before the body has arrived, then closes the connection.

    If the connection closes while the client still sends, TCP resets it and the client loses the answer. So
    the rest of the body is read and discarded for a while.
    """
    kept = [header for header in answer.headers if header[0].lower() != b"content-length"]
    length = (b"Content-Length", str(len(answer.body)).encode())
    await _send(answer._replace(headers=[*kept, length, (b"Connection", b"close")]), send, last=False)
    left = LINGER_BYTES
    with suppress(TimeoutError):
        async with asyncio.timeout(LINGER_S):
            while left > 0:
                message = await receive()
                left -= len(message.get("body", b""))  # type: ignore[arg-type]
                if not message.get("more_body", False):
                    break
    await send({"type": "http.response.body", "body": b"", "more_body": False})


def _headers(response: Any) -> list[tuple[bytes, bytes]]:
    pairs = [(name.encode("ascii"), value.encode("latin-1")) for name, value in response.items()]
    cookies = (cookie.output(header="").strip() for cookie in response.cookies.values())
    return pairs + [(b"Set-Cookie", cookie.encode("ascii")) for cookie in cookies]
