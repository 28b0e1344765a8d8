"""Reads the bodies of requests: checks headers first, limits size and speed, and writes files in threads.

Unidentified clients may send at most a megabyte. An *upload* is the body of one of the few routes that accept
an archive. It may be as large as the user's quota allows, and is written directly to a file.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import re
from dataclasses import dataclass
from functools import partial
from typing import IO, TYPE_CHECKING, Any, Final, NamedTuple

from django.db import OperationalError, close_old_connections

from backend.accounts.identity import identify
from backend.config.environment import environment
from backend.core import guard
from backend.core.problems import StudioError, database_problem, disk_problem, problem
from backend.core.processes.siblings import siblings
from backend.core.processes.threads import Threads
from backend.core.scopes import cookies_of, facts_of, headers_of

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable, Sequence

    from asgiref.typing import ASGIReceiveCallable, HTTPScope

    from backend.accounts.models import User
    from backend.core.processes.siblings import Place
    from backend.core.scratch import Scratch

UNKNOWN_BYTES: Final = 1024 * 1024
"""The largest body, in bytes, of a client that is not signed in."""
GUEST_BYTES: Final = 8 * 1024 * 1024
"""The largest body, in bytes, of a guest with a read-only link: two texts of a tree, to view it as XML."""
IN_MEMORY: Final = 4 * 1024 * 1024
"""Bytes; larger bodies are stored in a file."""
PART: Final = 1024 * 1024
"""Bytes that are written to a file in one step."""
PATIENCE_S: Final = 30.0
SLOWEST: Final = 8 * 1024
"""Bytes per second; slower bodies are refused after the first `PATIENCE_S`."""
LARGE_AT_ONCE: Final = 4
"""Bodies above `UNKNOWN_BYTES` that one user, or all guests together, may send at the same time."""
UPLOADS_AT_ONCE: Final = 1
RETRY_S: Final = 5
BODY: Final = "bt_studio.body"
"""The key of the body, a seekable file, in the scope of a request."""


class Body(NamedTuple):
    """A body as a seekable file."""

    file: IO[bytes]
    is_whole: bool = True
    """Whether the whole body was read. The body of a request that the guard refuses is not read."""


class Refused(NamedTuple):
    """The reason why a body is not read."""

    document: dict[str, Any]
    headers: dict[str, str]


class BodyRefusedError(Exception):
    """The body is too large or too slow, or its sender may not send it."""

    def __init__(self, document: dict[str, Any], retry_s: int | None = None) -> None:
        super().__init__(document["code"])
        self.refused = Refused(document, {} if retry_s is None else {"Retry-After": str(retry_s)})


class ClientLeftError(Exception):
    """The connection ended before the request was complete."""


@dataclass(frozen=True, slots=True)
class Upload:
    """A route that accepts archives; all others accept at most `BT_STUDIO_MAX_REQUEST_BYTES`.

    Attributes:
        path: a regular expression of the paths of the route.
        room: returns the number of bytes that a user may send; raises a StudioError if the user may send
            none.
        kind: the content type of streamed bodies; other types, such as forms, are not streamed.
    """

    path: str
    room: Callable[[User], int]
    kind: str = "application/octet-stream"

    def takes(self, scope: HTTPScope, kind: str) -> bool:
        """Returns whether a request is an upload for this route."""
        is_here = re.fullmatch(self.path, scope["path"]) is not None
        return scope["method"] == "POST" and is_here and kind.startswith(self.kind)


def body_of(request: Any) -> IO[bytes]:
    """Returns the body of a request that no parser reads, as a seekable file."""
    scope = getattr(request, "scope", {})
    return scope[BODY] if BODY in scope else io.BytesIO(request.body)


class Bodies:
    """Reads the bodies of requests.

    Args:
        asking: the threads with a connection to the database.
        uploads: the routes for archives.
        scratch: the temporary files for large bodies.
    """

    def __init__(self, asking: Threads, uploads: Sequence[Upload], scratch: Scratch) -> None:
        self._asking, self.uploads, self.scratch = asking, uploads, scratch
        self._writing = Threads(2, "bodies")

    @contextlib.asynccontextmanager
    async def read(
        self, scope: HTTPScope, receive: ASGIReceiveCallable, owner: str | None = None
    ) -> AsyncIterator[Body]:
        """Reads one body, and yields it; it exists until the block ends. Threads work on behalf of `owner`.

        Raises:
            BodyRefusedError: the body is refused, before or while it is read.
            ClientLeftError: the connection ended.
        """
        reading = _Reading(self, scope, receive, owner)
        try:
            body = await reading.whole()
            with body.file:
                yield body
        except StudioError as error:
            raise BodyRefusedError(error.document(), error.retry_after_s or None) from error
        except OSError as error:
            found = disk_problem(error)
            if found is None:
                raise
            raise BodyRefusedError(found) from error
        except OperationalError as error:
            raise BodyRefusedError(database_problem(error), RETRY_S) from error
        finally:
            reading.done()

    async def ask(self, work: Callable[[], Any], owner: str | None) -> Any:
        """Calls the function in a thread that has a connection to the database."""
        return await self._asking.run(asyncio.get_running_loop(), partial(_asked, work), owner)

    async def write(self, work: Callable[[], Any]) -> Any:
        """Calls a function that writes to the disk, or reads from it, in a thread."""
        return await self._writing.run(asyncio.get_running_loop(), work)


def _asked(work: Callable[[], Any]) -> Any:
    close_old_connections()
    return work()


class _Reading:
    """Reads the body of one request, into memory or into a temporary file."""

    def __init__(
        self, bodies: Bodies, scope: HTTPScope, receive: ASGIReceiveCallable, owner: str | None
    ) -> None:
        self._bodies, self._scope, self._receive, self._owner = bodies, scope, receive, owner
        self._headers = headers_of(scope)
        self._place: Place | None = None
        self._is_upload = False
        self._in_memory, self._most = IN_MEMORY, UNKNOWN_BYTES
        self._pending = bytearray()
        self._file: IO[bytes] | None = None
        self._size = 0

    async def whole(self) -> Body:
        """Reads the body to its end."""
        declared = self._declared()
        if declared or "transfer-encoding" in self._headers:
            # A request that is refused for its headers needs no body: the guard's middleware answers it.
            if guard.check(facts_of(self._scope)) is not None:
                return Body(io.BytesIO(), is_whole=False)
            await self._admit(declared or 0)
        return Body(await self._stored())

    def done(self) -> None:
        """Allows the user to send another large body."""
        if self._place is not None:
            self._place.give_back()

    def _declared(self) -> int | None:
        text = self._headers.get("content-length", "")
        return int(text) if text.isascii() and text.isdigit() else None

    async def _admit(self, declared: int) -> None:
        """Checks the headers, and refuses the body if it is too large."""
        kind, user = self._headers.get("content-type", ""), None
        upload = next((each for each in self._bodies.uploads if each.takes(self._scope, kind)), None)
        if upload is not None:
            user = await self._sender()
        if upload is not None and user is not None and not user.is_guest:
            self._take_slot(user, is_upload=True)
            room = await self._ask(partial(upload.room, user))
            self._most, self._in_memory = min(room, environment().max_temporary_bytes), PART
        elif declared > environment().max_request_bytes:
            raise _too_large(environment().max_request_bytes)
        if declared > self._most:
            await self._allow_more(declared)
        if declared > self._in_memory:  # fails before the body is sent if the disk has no room for it
            self._file = await self._bodies.write(partial(self._bodies.scratch.file, expected=declared))

    async def _allow_more(self, size: int) -> None:
        """Checks the sender before more than `UNKNOWN_BYTES` are accepted."""
        if self._place is None:
            user = await self._sender()
            if user is None:
                raise _too_large(UNKNOWN_BYTES, hint="Sign in to send more.")
            self._take_slot(user, is_upload=False)
            most = environment().max_request_bytes
            self._most = min(GUEST_BYTES, most) if user.is_guest else most
        if size > self._most:
            hint = "That is the room that you have left." if self._is_upload else ""
            raise _too_large(self._most, hint=hint)

    async def _sender(self) -> User | None:
        """Returns the user who sends this body, or None."""
        cookies = cookies_of(self._headers.get("cookie", ""))
        user: User | None = await self._ask(partial(identify, cookies))
        return user

    async def _ask(self, work: Callable[[], Any]) -> Any:
        return await self._bodies.ask(work, self._owner)

    def _take_slot(self, user: User, *, is_upload: bool) -> None:
        most = UPLOADS_AT_ONCE if is_upload else LARGE_AT_ONCE
        self._place = siblings.take(f"{'upload' if is_upload else 'body'} of {user.pk}", most)
        if self._place is None:
            sentence = f"You send {most} large file{'s' if most > 1 else ''} already."
            hint = "Wait until it has arrived."
            raise BodyRefusedError(problem(429, "throttled", detail=sentence, hint=hint), RETRY_S)
        self._is_upload = is_upload

    async def _stored(self) -> IO[bytes]:
        loop = asyncio.get_running_loop()
        began_s = loop.time()
        try:
            while True:
                try:
                    async with asyncio.timeout_at(began_s + PATIENCE_S + self._size / SLOWEST):
                        message = await self._receive()
                except TimeoutError:
                    raise _too_slow() from None
                if message["type"] == "http.disconnect":
                    raise ClientLeftError
                await self._take(message.get("body", b""))  # type: ignore[arg-type]
                if not message.get("more_body", False):
                    return await self._finished()
        except BaseException:
            if self._file is not None:
                self._file.close()
            raise

    async def _take(self, data: bytes) -> None:
        self._size += len(data)
        if self._size > self._most:
            await self._allow_more(self._size)
        self._pending += data
        if len(self._pending) > (self._in_memory if self._file is None else PART):
            await self._flush()

    async def _finished(self) -> IO[bytes]:
        if self._file is None:
            return io.BytesIO(bytes(self._pending))
        await self._flush()
        self._file.seek(0)
        return self._file

    async def _flush(self) -> None:
        data, self._pending = self._pending, bytearray()
        if self._file is None:
            self._file = await self._bodies.write(self._bodies.scratch.file)
        await self._bodies.write(partial(write_all, self._file, data))


def write_all(file: IO[bytes], data: bytes | bytearray) -> None:
    """Writes all of the data, since one call of an unbuffered file may write only a part."""
    view = memoryview(data)
    while view:
        view = view[file.write(view) :]


def _too_large(most: int, *, hint: str = "") -> BodyRefusedError:
    sentence = f"The body of this request may have at most {most:,} bytes."
    return BodyRefusedError(problem(413, "request_too_large", title="Too large", detail=sentence, hint=hint))


def _too_slow() -> BodyRefusedError:
    sentence = "The request came too slowly, or not to its end."
    hint = "Send it again over a better connection."
    return BodyRefusedError(problem(408, "request_too_slow", detail=sentence, hint=hint))
