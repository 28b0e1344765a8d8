"""The socket between an open page and its language server.

Each page has its own language server, since two tabs on one project have different unsaved texts. The servers
read the same folder. The relay restricts the page to its project: it translates addresses, passes on the
messages that an editor needs, and answers all others itself.

Close codes: 4404 no such project; 4408 idle (the page reconnects when it needs the server again); 4413 out of
memory, 4500 the server ended (the page reconnects after pauses); 4429 too many; 4503 not offered here.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import re
import time
from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Any, Final, NamedTuple
from uuid import UUID

from channels.db import database_sync_to_async

from backend.config.environment import environment
from backend.core.problems import NotFoundError
from backend.core.tasks import ended
from backend.ingress.sockets import ID, Call, Closed
from backend.language.errors import UnavailableError
from backend.language.folder import SUFFIXES
from backend.language.places import launcher
from backend.language.protocol.addresses import PROJECT, Addresses, ForeignAddressError, path_of
from backend.language.protocol.framing import FramingError, Unframer, framed
from backend.language.protocol.messages import for_page, for_server, source_asked
from backend.language.waiting import enter, placed
from backend.projects.api.notices import notices_of
from backend.projects.documents import checking
from backend.projects.storage import queries
from backend.projects.storage.access import Need

if TYPE_CHECKING:
    from asgiref.typing import ASGIReceiveCallable, ASGISendCallable

    from backend.accounts.models import User
    from backend.language.folder import Sync
    from backend.language.servers import Server

log = logging.getLogger(__name__)

ADDRESS: Final = re.compile(rf"^/ws/projects/{ID}/language$")
MAX_MESSAGE_BYTES: Final = 4 * 1024 * 1024
WATCH_S: Final = 1.0

NO_SUCH_PROJECT: Final = 4404
IDLE: Final = 4408
TOO_MUCH_MEMORY: Final = 4413
TOO_MANY: Final = 4429
ENDED: Final = 4500
UNAVAILABLE: Final = 4503

_NO_SOURCE: Final = {"code": -32602, "message": "This file cannot be shown."}

Following = Callable[[], Awaitable[dict[str, Any]]]


async def serve_language(call: Call, receive: ASGIReceiveCallable, send: ASGISendCallable) -> Closed | None:
    """Serves one page until either side ends."""
    ticket = enter(call.user)
    if ticket is None:
        return Closed(TOO_MANY, "Too many editors wait for the language server.")
    try:
        async with placed(ticket, receive, send) as rest:
            if rest is None:
                return None
            async with notices_of(UUID(call.address[1])) as following:
                return await _serve(Page(UUID(call.address[1]), call.user, rest, send), following)
    except NotFoundError:
        return Closed(NO_SUCH_PROJECT, "There is no such project.")
    except UnavailableError as error:
        return Closed(UNAVAILABLE, str(error))
    finally:
        ticket.give_back()


async def _serve(page: Page, following: Following) -> Closed | None:
    starting = launcher()
    # Reading the files also checks that the user may access the project, before a server starts.
    contents = await database_sync_to_async(_contents)(page)
    server = await starting.start(page.project_id, page.user, contents)
    try:
        return await Relay(page, server).run(following)
    finally:
        await server.stop()


def _contents(page: Page) -> dict[str, bytes]:
    project = queries.project(page.project_id, user=page.user, need=Need.WRITE)
    files = [file for path, file in queries.existing_files(project).items() if path.endswith(SUFFIXES)]
    if sum(file.size for file in files) > checking.MOST_CHECKED:
        raise UnavailableError("The Python of this project is too large for help with it.")
    return queries.data_of(files)


class Page(NamedTuple):
    """The page at the other end of the socket."""

    project_id: UUID
    user: User
    receive: ASGIReceiveCallable
    send: ASGISendCallable


class Relay:
    """Connects one page with its server."""

    def __init__(self, page: Page, server: Server) -> None:
        self._page = page
        self._server = server
        self._addresses = Addresses(server.root, server.sources)
        self._writing = asyncio.Lock()
        self._last_heard_s = time.monotonic()

    async def run(self, following: Following) -> Closed | None:
        """Relays until either side ends.

        Returns the close message for the page, or None if the page has left.
        """
        tasks = [
            asyncio.create_task(each)
            for each in (self._from_page(), self._from_server(), self._watch(), self._follow(following))
        ]
        try:
            done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
            return await next(task for task in tasks if task in done)
        finally:
            await ended(*tasks)

    async def _from_page(self) -> Closed | None:
        while True:
            event: Any = await self._page.receive()
            if event["type"] == "websocket.disconnect":
                return None
            self._last_heard_s = time.monotonic()
            text = event.get("text") or ""
            if len(text) > MAX_MESSAGE_BYTES:
                return Closed(1009, "A message is too large.")
            try:
                message = self._addresses.inward(json.loads(text))
            except ForeignAddressError as error:
                await self._refuse(text, str(error))
                continue
            except (ValueError, RecursionError):
                return Closed(1003, "A message is not JSON.")
            if (asked := source_asked(message)) is not None:
                await self._tell(await self._source(*asked))
                continue
            passed, answer = for_server(message, f"file://{self._server.root}")
            if answer is not None:
                await self._tell(answer)
            if passed is not None and not await self._write(passed):
                return Closed(ENDED, "The language server has ended.")

    async def _source(self, message_id: Any, uri: str) -> dict[str, Any]:
        """Answers the page's request for a file outside of the project; only sources are given out."""
        try:
            text = await self._server.source(path_of(uri))
        except OSError:
            text = None
        answer = {"error": _NO_SOURCE} if text is None else {"result": {"text": text}}
        return {"jsonrpc": "2.0", "id": message_id} | answer

    async def _from_server(self) -> Closed | None:
        unframer = Unframer()
        with contextlib.suppress(FramingError, ValueError, OSError):
            while data := await self._server.read():
                for body in unframer.feed(data):
                    shown, answer = for_page(json.loads(body))
                    if answer is not None:
                        await self._write(answer)
                    if shown is not None:
                        await self._tell(self._addresses.outward(shown))
        return Closed(ENDED, "The language server has ended.")

    async def _follow(self, following: Following) -> Closed | None:
        """Updates the folder after each new revision, and notifies the server."""
        while True:
            await following()
            try:
                contents = await database_sync_to_async(_contents)(self._page)
            except NotFoundError:
                await self._server.forget()
                return Closed(NO_SUCH_PROJECT, "The project was deleted.")
            try:
                changes = await self._server.sync(contents)
            except OSError:
                return Closed(ENDED, "The language server has ended.")
            await self._write(self._watched(changes))

    def _watched(self, changes: Sync) -> dict[str, Any]:
        kinds = (changes.created, changes.changed, changes.deleted)
        told = [
            {"uri": f"{PROJECT}/{path}", "type": kind}
            for kind, paths in enumerate(kinds, start=1)
            for path in paths
        ]
        notice = {"jsonrpc": "2.0", "method": "workspace/didChangeWatchedFiles", "params": {"changes": told}}
        mapped: dict[str, Any] = self._addresses.inward(notice)
        return mapped

    async def _watch(self) -> Closed | None:
        limits = environment()
        while True:
            await asyncio.sleep(WATCH_S)
            if time.monotonic() - self._last_heard_s > limits.language_idle_s:
                return Closed(IDLE, "Nobody has typed for a while.")
            if self._server.memory_bytes() > limits.language_memory_mib * 1024 * 1024:
                log.warning("project %s: the language server takes too much memory", self._page.project_id)
                return Closed(TOO_MUCH_MEMORY, "The language server took too much memory.")

    async def _refuse(self, text: str, reason: str) -> None:
        message = json.loads(text)
        if isinstance(message, dict) and "id" in message:
            error = {"code": -32602, "message": reason}
            await self._tell({"jsonrpc": "2.0", "id": message["id"], "error": error})

    async def _write(self, message: dict[str, Any]) -> bool:
        body = framed(json.dumps(message, ensure_ascii=False).encode())
        try:
            async with self._writing:
                await self._server.write(body)
        except (OSError, RuntimeError):
            return False
        return True

    async def _tell(self, message: dict[str, Any]) -> None:
        text = json.dumps(message, ensure_ascii=False)
        await self._page.send({"type": "websocket.send", "text": text, "bytes": None})
