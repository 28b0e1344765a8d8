"""Sends answers in windows that a client must read in time, so that no answer stays in memory forever."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from functools import partial
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from backend.core.connection_costs import ABORT
from backend.core.file_answers import PART
from backend.ingress.bodies import PATIENCE_S, SLOWEST

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable, HTTPScope

WINDOW: Final = int(PATIENCE_S * SLOWEST)
"""Bytes of an answer that a client must read in `PATIENCE_S`."""
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


class SlowReaderError(Exception):
    """The client reads less than `WINDOW` bytes in `PATIENCE_S`."""


async def send_answer(answer: Answer, send: ASGISendCallable, *, last: bool = True) -> None:
    """Sends an answer; returns when the client has read most of it.

    Raises:
        SlowReaderError: the client reads too slowly, or not at all.
    """
    start = {"status": answer.status, "headers": answer.headers, "trailers": False}
    await _send(send, {"type": "http.response.start"} | start)
    body = answer.body
    if len(body) > WINDOW:
        await _send_windows(body, send)
        body = b""
    await _send(send, {"type": "http.response.body", "body": body, "more_body": not last})


async def send_file(
    answer: Answer,
    file: IO[bytes],
    read: Callable[[Callable[[], bytes]], Awaitable[Any]],
    send: ASGISendCallable,
) -> None:
    """Sends a file as fast as the client reads, and closes it; `read` calls a function in a thread.

    Raises:
        SlowReaderError: the client reads too slowly, or not at all.
    """
    with file:
        await send_answer(answer, send, last=False)
        while part := await read(partial(file.read, PART)):
            await _send_windows(part, send)
        await _send(send, {"type": "http.response.body", "body": b"", "more_body": False})


async def send_and_close(answer: Answer, receive: ASGIReceiveCallable, send: ASGISendCallable) -> None:
    """Answers before the body has arrived, then closes the connection.

    If the connection closes while the client still sends, TCP resets it and the client loses the answer. So
    the rest of the body is read and discarded for a while.

    Raises:
        SlowReaderError: the client reads too slowly, or not at all.
    """
    kept = [header for header in answer.headers if header[0].lower() != b"content-length"]
    length = (b"Content-Length", str(len(answer.body)).encode())
    closing = answer._replace(headers=[*kept, length, (b"Connection", b"close")])
    await send_answer(closing, send, last=False)
    left = LINGER_BYTES
    with suppress(TimeoutError):
        async with asyncio.timeout(LINGER_S):
            while left > 0:
                message = await receive()
                left -= len(message.get("body", b""))  # type: ignore[arg-type]
                if not message.get("more_body", False):
                    break
    await _send(send, {"type": "http.response.body", "body": b"", "more_body": False})


async def cut(scope: HTTPScope) -> None:
    """Ends a connection with what is still unsent; closing it would wait for the client."""
    abort: Any = scope.get(ABORT)
    if abort is not None:
        abort()
        await asyncio.sleep(0)  # uvicorn notices the end of the connection


async def _send_windows(data: bytes, send: ASGISendCallable) -> None:
    """Sends bytes; the next window is sent when the client has read most of the last one."""
    view = memoryview(data)
    for at in range(0, len(view), WINDOW):
        part = bytes(view[at : at + WINDOW])
        await _send(send, {"type": "http.response.body", "body": part, "more_body": True})


async def _send(send: ASGISendCallable, message: dict[str, Any]) -> None:
    """Sends a message once the client has read most of those before.

    Raises:
        SlowReaderError: it does not read them in time.
    """
    sending: Any = message
    try:
        async with asyncio.timeout(PATIENCE_S):
            await send(sending)
    except TimeoutError as error:
        raise SlowReaderError from error
