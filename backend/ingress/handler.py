"""Runs Django for HTTP; one thread of a fixed pool handles each request from beginning to end.

Django's ASGI handler makes a thread for each request, and switches several times between the thread and the
event loop, although no view of this server is asynchronous. That took longer than most views.
"""

from __future__ import annotations

import asyncio
import contextvars
import logging
import os
import time
from contextlib import asynccontextmanager
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
from backend.core.readers import ReadersBusyError, Reading, reading
from backend.core.scratch import scratch
from backend.ingress.bodies import BODY, Bodies, BodyRefusedError, ClientLeftError, Refused
from backend.ingress.middleware import secured
from backend.ingress.owners import owner_of
from backend.ingress.sending import Answer, SlowReaderError, cut, send_and_close, send_answer, send_file
from backend.ingress.turns import turns
from backend.workers.deferred import Deferred

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable
    from concurrent.futures import Future

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, HTTPScope
    from django.http import HttpRequest

    from backend.ingress.bodies import Upload

log = logging.getLogger(__name__)

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


class Unfinished(NamedTuple):
    """A response that waits for a worker, and needs no thread until then."""

    request: HttpRequest
    response: Deferred


class ThreadedHandler(ASGIHandler):
    """Django as an ASGI application for HTTP only.

    Args:
        uploads: the routes for archives.
        hashing: the number of passwords that are hashed at the same time; the default depends on the machine.
    """

    def __init__(self, *uploads: Upload, hashing: int | None = None) -> None:
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
        self._bodies = Bodies(self.threads, uploads, scratch())

    async def __call__(self, scope: HTTPScope, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:  # type: ignore[override]
        """Reads the request, answers it in a thread, and sends the answer."""
        owner = owner_of(scope)
        known(scope, owner)
        turns.spend(owner, LOOP_S)
        held = Reading(owner)
        reading.set(held)
        try:
            await self._served(scope, receive, send, owner, held)
        finally:
            held.close()

    async def _served(
        self,
        scope: HTTPScope,
        receive: ASGIReceiveCallable,
        send: ASGISendCallable,
        owner: str,
        held: Reading,
    ) -> None:
        try:
            async with self._bodies.read(scope, receive, owner) as body:
                # Context variables of a request (language, address) must not stay set in the thread.
                context = contextvars.copy_context()
                work = partial(context.run, self._answer, scope, body.file)
                async with self._turn(scope) as has_turn:
                    answer = await self._answered(work, None if has_turn else owner)
                while isinstance(answer, Unfinished):
                    if await _is_left(answer.response, receive):
                        await self.threads.run(asyncio.get_running_loop(), answer.response.close, owner)
                        return
                    answer = await self._answered(partial(context.run, self._complete, answer), owner)
        except ClientLeftError:
            return
        except BodyRefusedError as error:
            await send_and_close(_refusal(scope, error.refused), receive, send)
            return
        answer = _counted(scope, answer, held)
        try:
            if answer.file is not None:
                await send_file(answer, answer.file, self._bodies.write, send)
            else:
                await (send_answer(answer, send) if body.is_whole else send_and_close(answer, receive, send))
        except SlowReaderError:
            log.info("a client read its answer too slowly, and was disconnected: %s", scope["path"])
            await cut(scope)

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


async def _is_left(response: Deferred, receive: ASGIReceiveCallable) -> bool:
    """Waits for the work of a response; returns whether the client left before, which has ended the work."""
    if response.cancel is None:
        await _ended(response.work)
        return False
    ended = asyncio.ensure_future(_ended(response.work))
    leaves = asyncio.ensure_future(_left(receive))
    await asyncio.wait({ended, leaves}, return_when=asyncio.FIRST_COMPLETED)
    is_left = not ended.done()
    leaves.cancel()
    if is_left:
        # It may wait, for a socket or a lock; the event loop must not.
        await asyncio.get_running_loop().run_in_executor(None, response.cancel)
    await ended
    return is_left


async def _left(receive: ASGIReceiveCallable) -> None:
    """Waits until the client has left; its body has been received."""
    if (await receive())["type"] != "http.disconnect":
        await asyncio.Event().wait()


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
        _without_cycles(response)


def _without_cycles(response: Any) -> None:
    """Breaks the cycles of DRF's request, view and response.

    Otherwise all that was sent and answered would stay in memory until the garbage collector comes.
    """
    context = vars(response).pop("renderer_context", None) or {}
    view, request = context.get("view"), context.get("request")
    if view is not None:
        vars(view).clear()
    if request is not None:
        request.parser_context = {}


def _tell_length(scope: HTTPScope, body: IO[bytes]) -> None:
    """Sets the length of a body that was sent in chunks. Without a length, Django's parsers read no body."""
    if any(name == b"transfer-encoding" for name, _ in scope["headers"]):
        kept = [row for row in scope["headers"] if row[0] not in {b"transfer-encoding", b"content-length"}]
        size = body.seek(0, os.SEEK_END)
        body.seek(0)
        scope["headers"] = [*kept, (b"content-length", str(size).encode())]


def _counted(scope: HTTPScope, answer: Answer, held: Reading) -> Answer:
    """Counts an answer until it has arrived; returns a refusal instead if too many are on their way.

    The answer to a write is never refused, since the write is done.
    """
    size = len(answer.body) if answer.file is None else PART
    try:
        held.settle(size, must=scope["method"] not in {"GET", "HEAD"} or answer.status >= 400)
    except ReadersBusyError as error:
        if answer.file is not None:
            answer.file.close()
        return _refusal(scope, Refused(error.document(), error.headers))
    return answer


def _refusal(scope: HTTPScope, refused: Refused) -> Answer:
    response = problem_response(refused.document, refused.headers)
    secured(scope["path"], response)
    return Answer(response.status_code, _headers(response), response.content)


def _headers(response: Any) -> list[tuple[bytes, bytes]]:
    pairs = [(name.encode("ascii"), value.encode("latin-1")) for name, value in response.items()]
    cookies = (cookie.output(header="").strip() for cookie in response.cookies.values())
    return pairs + [(b"Set-Cookie", cookie.encode("ascii")) for cookie in cookies]
