"""The interface of language servers, and the implementation by child processes for localhost.

On servers that run sessions in containers, language servers also run there (`containers.py`), since their
users must be isolated from each other. A server with accounts but without containers offers no language
servers; users then get a message.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import resource
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final, Protocol

import psutil

from backend.language.errors import UnavailableError
from backend.language.folder import Folder, Sync, library
from translator.python_help import environment_of, read_source, source_roots

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

    from backend.accounts.models import User

# This limits the address space of a server out of control. The limit of memory is enforced below.
ADDRESS_SPACE_BYTES: Final = 8 * 1024**3
STOP_S: Final = 2.0
_CHUNK_BYTES: Final = 64 * 1024


class Server(Protocol):
    """A running language server: bytes in, bytes out, and a folder of files that it reads."""

    @property
    def root(self) -> str:
        """The absolute path of the project's files as the server sees it."""

    @property
    def sources(self) -> Mapping[str, str]:
        """The folders of sources outside of the project that may be read, by label."""

    async def sync(self, contents: Mapping[str, bytes]) -> Sync:
        """Makes the server's folder contain exactly the Python files among these files."""

    async def write(self, data: bytes) -> None:
        """Sends bytes to the server; waits until the server accepts them."""

    async def read(self) -> bytes:
        """Waits for the next bytes of the server, and returns them; empty at the end."""

    async def source(self, path: str) -> str | None:
        """Returns the text of a file below one of the `sources`; None for all other files."""

    def memory_bytes(self) -> int:
        """Returns the memory that the server uses now, in bytes; 0 if it has ended."""

    async def stop(self) -> None:
        """Ends the server; may be called twice."""

    async def forget(self) -> None:
        """Removes the files of a deleted project."""


class Launcher(Protocol):
    """Starts language servers."""

    async def start(self, project_id: UUID, user: User, contents: Mapping[str, bytes]) -> Server:
        """Starts a language server on the files of a project, for one of its users.

        Raises:
            UnavailableError: the web server offers no language servers, or the language server cannot be
                started.
        """


class ProcessServer:
    """A language server in a child process."""

    def __init__(self, process: asyncio.subprocess.Process, folder: Folder) -> None:
        self._process = process
        self._folder = folder
        self._sources = source_roots(folder.home, library())

    @property
    def root(self) -> str:
        return str(self._folder.files)

    @property
    def sources(self) -> Mapping[str, str]:
        return self._sources

    async def sync(self, contents: Mapping[str, bytes]) -> Sync:
        return await asyncio.to_thread(self._folder.sync, contents)

    async def write(self, data: bytes) -> None:
        assert self._process.stdin is not None  # noqa: S101 - for the type checker
        self._process.stdin.write(data)
        await self._process.stdin.drain()

    async def read(self) -> bytes:
        assert self._process.stdout is not None  # noqa: S101 - for the type checker
        return await self._process.stdout.read(_CHUNK_BYTES)

    async def source(self, path: str) -> str | None:
        return await asyncio.to_thread(read_source, path, self._sources.values())

    def memory_bytes(self) -> int:
        """Returns the resident memory in bytes."""
        try:
            return int(psutil.Process(self._process.pid).memory_info().rss)
        except psutil.Error:
            return 0

    async def stop(self) -> None:
        """Closes the server's input, after which it should end; kills it if it does not."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        try:
            await asyncio.wait_for(self._process.wait(), STOP_S)
        except TimeoutError:
            with contextlib.suppress(ProcessLookupError):
                self._process.kill()
            await self._process.wait()

    async def forget(self) -> None:
        """Removes the folder."""
        await asyncio.to_thread(self._folder.remove)


class ProcessLauncher:
    """Starts `ty server` as a child process with one thread, low priority, and an empty environment.

    The child ends when its input ends, so it never outlives the web server.
    """

    def __init__(self, command: tuple[str, ...] = ()) -> None:
        self._command = command or (str(Path(sys.executable).with_name("ty")), "server")

    async def start(self, project_id: UUID, user: User, contents: Mapping[str, bytes]) -> Server:
        folder = Folder(project_id)
        await asyncio.to_thread(folder.prepare)
        await asyncio.to_thread(folder.sync, contents)
        try:
            process = await asyncio.create_subprocess_exec(
                *self._command,
                cwd=folder.home,
                env=environment_of(folder.home),
                stdin=asyncio.subprocess.PIPE,
                stdout=asyncio.subprocess.PIPE,
                stderr=asyncio.subprocess.DEVNULL,
                start_new_session=True,
            )
        except OSError as error:
            raise UnavailableError(f"The language server cannot be started: {error.strerror}.") from error
        with contextlib.suppress(OSError, ValueError):
            resource.prlimit(process.pid, resource.RLIMIT_AS, (ADDRESS_SPACE_BYTES, ADDRESS_SPACE_BYTES))
            os.setpriority(os.PRIO_PROCESS, process.pid, 5)
        return ProcessServer(process, folder)
