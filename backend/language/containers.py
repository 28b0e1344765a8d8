"""Language servers in the containers of their users; the web server only sends files and relays bytes."""

from __future__ import annotations

import asyncio
import hashlib
import json
from typing import TYPE_CHECKING, Any

from websockets.exceptions import ConnectionClosed

from backend.language import tools
from backend.language.errors import UnavailableError
from backend.language.folder import Sync, python_of
from backend.language.library import configuration

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

    from websockets.asyncio.client import ClientConnection

    from backend.accounts.models import User
    from backend.language.servers import Server


class ContainerServer:
    """A language server that is reached over a socket of `executor.tools`."""

    def __init__(self, connection: ClientConnection, home: str, sources: Mapping[str, str]) -> None:
        self._connection = connection
        self._home = home
        self._sources = sources
        self._asked: dict[str, asyncio.Future[str | None]] = {}
        self._sent: dict[str, bytes] = {}
        self._memory_bytes = 0

    @property
    def root(self) -> str:
        """The project's folder inside the container."""
        return f"{self._home}/files"

    @property
    def sources(self) -> Mapping[str, str]:
        """The folders of the container that its tools give out."""
        return self._sources

    async def begin(self, contents: Mapping[str, bytes], library: str, python: str) -> None:
        """Sends the initial files and starts the server."""
        await self._send_files({"ty.toml": configuration(self.root, library, python)})
        await self.sync(contents)

    async def sync(self, contents: Mapping[str, bytes]) -> Sync:
        """Sends the files that have changed since the last call."""
        before, wanted = self._sent, python_of(contents)
        self._sent = now = {path: hashlib.sha256(data).digest() for path, data in wanted.items()}
        changed = {path for path in now.keys() & before.keys() if now[path] != before[path]}
        created, deleted = now.keys() - before.keys(), before.keys() - now.keys()
        files: dict[str, str | None] = {f"files/{path}": None for path in deleted}
        files |= {f"files/{path}": wanted[path].decode(errors="replace") for path in created | changed}
        await self._send_files(files)
        return Sync(tuple(sorted(created)), tuple(sorted(changed)), tuple(sorted(deleted)))

    async def _send_files(self, files: Mapping[str, str | None]) -> None:
        await self._send(json.dumps({"files": files}))

    async def _send(self, data: str | bytes) -> None:
        try:
            await self._connection.send(data)
        except ConnectionClosed as error:
            raise BrokenPipeError("the language server has ended") from error

    async def write(self, data: bytes) -> None:
        await self._send(data)

    async def read(self) -> bytes:
        """Returns the next bytes of the language server; stores the other messages of the tools."""
        try:
            while isinstance(message := await self._connection.recv(), str):
                self._hear(json.loads(message))
        except ConnectionClosed:
            return b""
        return message

    def _hear(self, told: dict[str, Any]) -> None:
        if "memory_bytes" in told:
            self._memory_bytes = int(told["memory_bytes"])
        elif (asked := self._asked.pop(str(told["source"]), None)) and not asked.done():
            text = told["text"]
            asked.set_result(None if text is None else str(text))

    async def source(self, path: str) -> str | None:
        """Asks the tools, which read only below their own folders; the answer arrives in `read`."""
        if path not in self._asked:
            self._asked[path] = asyncio.get_running_loop().create_future()
            await self._send(json.dumps({"source": path}))
        try:
            return await asyncio.wait_for(asyncio.shield(self._asked[path]), tools.ANSWER_S)
        except TimeoutError:
            self._asked.pop(path, None)
            return None

    def memory_bytes(self) -> int:
        """Returns the last reported memory in bytes; the report is at most a second old."""
        return self._memory_bytes

    async def stop(self) -> None:
        """Closes the socket; the server ends, and its folder is removed."""
        await self._connection.close()

    async def forget(self) -> None:
        """Does nothing, since no files are kept."""


class ContainerLauncher:
    """Starts language servers in a user's tools container."""

    async def start(self, project_id: UUID, user: User, contents: Mapping[str, bytes]) -> Server:
        """Opens a socket to the tools, and sends the files."""
        connection = await tools.open_editor(user)
        try:
            told: dict[str, Any] = json.loads(await connection.recv())
            server = ContainerServer(connection, str(told["home"]), _folders(told["sources"]))
            await server.begin(contents, str(told["library"]), str(told["python"]))
        except (OSError, ConnectionClosed, ValueError, KeyError, AttributeError) as error:
            await connection.close()
            raise UnavailableError("The language server cannot be started.") from error
        return server


def _folders(told: dict[str, Any]) -> dict[str, str]:
    return {label: str(folder) for label, folder in told.items()}
