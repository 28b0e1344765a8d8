"""A child with all that it starts, which is ended before its number is free.

asyncio's own subprocesses are reaped by another thread as soon as they exit. A signal to their group could
then reach another process that has got their number.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import subprocess
import threading
from typing import IO, TYPE_CHECKING, cast

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["Group"]


class Group:
    """A child in its own session.

    Args:
        arguments: the command.
        folder: its working directory.
        environment: its variables.
    """

    def __init__(self, arguments: Sequence[str], *, folder: str, environment: Mapping[str, str]) -> None:
        self._process = subprocess.Popen(
            arguments,
            bufsize=0,
            cwd=folder,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            start_new_session=True,
        )
        self._writing = threading.Lock()
        self._pipes: list[asyncio.BaseTransport] = []

    async def outputs(self) -> tuple[asyncio.StreamReader, asyncio.StreamReader]:
        """Returns its standard output and its standard error."""
        out, err = [await self._opened(pipe) for pipe in (self._process.stdout, self._process.stderr)]
        return out, err

    async def _opened(self, pipe: IO[bytes] | None) -> asyncio.StreamReader:
        stream = asyncio.StreamReader()
        transport, _ = await asyncio.get_running_loop().connect_read_pipe(
            lambda: asyncio.StreamReaderProtocol(stream), pipe
        )
        self._pipes.append(transport)
        return stream

    async def write(self, data: bytes) -> None:
        """Writes to its standard input.

        Raises:
            OSError: it does not read any more.
        """
        await asyncio.to_thread(self._write, data)

    def _write(self, data: bytes) -> None:
        with self._writing:
            view = memoryview(data)
            while view:
                view = view[self._input.write(view) :]

    def close_input(self) -> None:
        """Closes its standard input; waits for what is being written."""
        with self._writing, contextlib.suppress(OSError):
            self._input.close()

    @property
    def _input(self) -> IO[bytes]:
        return cast("IO[bytes]", self._process.stdin)

    async def exited(self) -> None:
        """Waits until the child itself has exited; its number stays its own."""
        loop, is_over = asyncio.get_running_loop(), asyncio.Event()
        number = os.pidfd_open(self._process.pid)
        loop.add_reader(number, is_over.set)
        try:
            await is_over.wait()
        finally:
            loop.remove_reader(number)
            os.close(number)

    def end(self) -> int:
        """Ends all of the group that still runs; returns the exit status of the child."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)  # it is not reaped yet
        status = self._process.wait()
        self.close_input()
        for pipe in self._pipes:
            pipe.close()
        return status
