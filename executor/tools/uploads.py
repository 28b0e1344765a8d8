"""Imports robots and worlds from uploads: each in its own child, `executor.uploads`."""

from __future__ import annotations

import asyncio
import logging
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.tools.answering import answer
from executor.tools.groups import Group

if TYPE_CHECKING:
    from collections.abc import AsyncIterable

    from websockets.asyncio.server import ServerConnection

__all__ = ["import_upload", "serve_uploads"]

log = logging.getLogger(__name__)

LIMIT_S: Final = 90.0
"""By the clock, on a busy machine; the child's processor time is bounded by itself."""
CHILD: Final = "executor.uploads"
_SAID_BYTES: Final = 2_000
_ROOT: Final = str(Path(__file__).resolve().parents[2])
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH", "AMENT_PREFIX_PATH")


async def serve_uploads(connection: ServerConnection, folder: Path) -> None:
    """Receives a header as JSON, a line feed and the upload; answers as `executor.uploads`.

    The answer is "" if the child gave none. The child ends with the connection.
    """
    await answer(connection, import_upload(connection.recv_streaming(decode=False), folder))


async def import_upload(parts: AsyncIterable[bytes], folder: Path) -> str:
    """Returns the answer of the child; "" if it gave none. It is ended if this is cancelled."""
    output = said = b""
    status = -1
    environment = {key: os.environ[key] for key in _PASSED if key in os.environ}
    with tempfile.TemporaryDirectory(dir=folder) as scratch:
        child = Group(
            [sys.executable, "-m", CHILD, scratch],
            folder=_ROOT,
            environment=environment | {"OPENBLAS_NUM_THREADS": "1"},
        )
        try:
            async with asyncio.timeout(LIMIT_S):
                out, err = await child.outputs()
                _, output, said = await asyncio.gather(_pass(parts, child), out.read(), _end_of(err))
                await child.exited()
        except TimeoutError:
            pass
        finally:
            status = child.end()  # with the child of the macros
    if status != 0:
        log.warning("the child of an import ended with status %s: %r", status, said)
        return ""
    return output.decode()


async def _pass(parts: AsyncIterable[bytes], to: Group) -> None:
    """Passes an upload on, without all of it in memory; what a child does not want is read all the same."""
    is_wanted = True
    async for part in parts:
        if is_wanted:
            try:
                await to.write(part)
            except OSError:
                is_wanted = False
    to.close_input()


async def _end_of(stream: asyncio.StreamReader) -> bytes:
    end = b""
    while part := await stream.read(1 << 16):
        end = (end + part)[-_SAID_BYTES:]
    return end
