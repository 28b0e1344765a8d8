"""One open editor: a folder with its project's Python, and a language server on it.

The first message goes to the web server: `{home, library, python}`, the paths for the configuration that it
writes, and `sources`, the folders beside the project whose Python it may ask for. Then the web server sends

    {"files": {path: text, or null to remove}}   as text; the first starts the language server
    {"source": path}                             as text; answered by {"source": path, "text": text or null}
    messages of the editor                       as bytes, relayed unchanged

and receives the bytes of the language server, and sometimes `{"memory_bytes": n}` as text. Order is
preserved: a file that was sent before some bytes exists when the language server reads them. The connection
ends when either side ends, with a reason if the disk is full.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import sys
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Final, NamedTuple

import psutil

from translator.python_help import environment_of, read_source, source_roots

if TYPE_CHECKING:
    from collections.abc import Mapping

    from websockets.asyncio.server import ServerConnection

__all__ = ["LIBRARY", "put_files", "serve_editor"]

# Modules that every project can import; written when the image is built.
LIBRARY: Final = "/opt/bt-studio/library"
COMMAND: Final = (str(Path(sys.executable).with_name("ty")), "server")
STOP_S: Final = 2.0
WATCH_S: Final = 1.0
NO_ROOM: Final = 1011
_CHUNK_BYTES: Final = 64 * 1024


async def serve_editor(connection: ServerConnection, home: Path, command: tuple[str, ...] = COMMAND) -> None:
    """Serves one editor in a new empty folder, until either side ends."""
    sources = source_roots(home, Path(LIBRARY))
    told = {"home": str(home), "library": LIBRARY, "python": sys.executable, "sources": sources}
    await connection.send(json.dumps(told))
    try:
        put_files(home, json.loads(await connection.recv())["files"])
    except OSError as error:
        await connection.close(NO_ROOM, _reason(error))
        return
    process = await asyncio.create_subprocess_exec(
        *command,
        cwd=home,
        env=environment_of(home),
        stdin=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.DEVNULL,
    )
    try:
        await _relay(connection, process, Place(home, tuple(sources.values())))
    finally:
        await _end(process)


class Place(NamedTuple):
    """The folders that an editor's messages may name: its own one, and those of sources."""

    home: Path
    sources: tuple[str, ...]


async def _relay(connection: ServerConnection, process: asyncio.subprocess.Process, place: Place) -> None:
    steps = (_inward(connection, process, place), _outward(connection, process), _watch(connection, process))
    tasks = [asyncio.create_task(step) for step in steps]
    try:
        await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)


async def _inward(connection: ServerConnection, process: asyncio.subprocess.Process, place: Place) -> None:
    assert process.stdin is not None  # noqa: S101 - for the type checker
    async for message in connection:
        if isinstance(message, bytes):
            process.stdin.write(message)
            await process.stdin.drain()
            continue
        asked = json.loads(message)
        if "source" in asked:
            text = await asyncio.to_thread(read_source, asked["source"], place.sources)
            await connection.send(json.dumps({"source": asked["source"], "text": text}))
            continue
        try:
            put_files(place.home, asked["files"])
        except OSError as error:
            await connection.close(NO_ROOM, _reason(error))
            return


async def _outward(connection: ServerConnection, process: asyncio.subprocess.Process) -> None:
    assert process.stdout is not None  # noqa: S101 - for the type checker
    while data := await process.stdout.read(_CHUNK_BYTES):
        await connection.send(data)


async def _watch(connection: ServerConnection, process: asyncio.subprocess.Process) -> None:
    while True:
        await asyncio.sleep(WATCH_S)
        with contextlib.suppress(psutil.Error):
            held = int(psutil.Process(process.pid).memory_info().rss)
            await connection.send(json.dumps({"memory_bytes": held}))


async def _end(process: asyncio.subprocess.Process) -> None:
    assert process.stdin is not None  # noqa: S101 - for the type checker
    process.stdin.close()
    try:
        await asyncio.wait_for(process.wait(), STOP_S)
    except TimeoutError:
        with contextlib.suppress(ProcessLookupError):
            process.kill()
        await process.wait()


def put_files(home: Path, files: Mapping[str, str | None]) -> None:
    """Writes and removes files below a folder.

    Raises:
        OSError: a path is outside of the folder, or the disk is full.
    """
    for path, text in files.items():
        parts = PurePosixPath(path).parts
        if not parts or path.startswith("/") or ".." in parts:
            raise PermissionError(f"{path!r} is no place in the folder")
        target = home.joinpath(*parts)
        if text is None:
            target.unlink(missing_ok=True)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        partial = target.with_name(f".{target.name}.partial")
        partial.write_text(text, encoding="utf-8")
        partial.replace(target)


def _reason(error: OSError) -> str:
    return (error.strerror or str(error))[:100]
