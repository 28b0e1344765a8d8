"""Gives the recording of a run over HTTP, as one file in parts: `GET /recordings/<run>/<branch>`.

`last` instead of the name of a run is the one that was recorded last.

A request for the begin joins the segments again, in a process of its own; requests for later parts read the
same file, which its `ETag` names. One answer holds at most 8 MiB, so that no run is held in memory. Where the
disk is full the file is one in memory, so that what was recorded before can be had.
"""

from __future__ import annotations

import asyncio
import os
import re
import sys
from contextlib import nullcontext
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Final

from websockets.datastructures import Headers
from websockets.http11 import Response

from executor.recorder.joining import NO_ROOM, NOT_RECORDED

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from websockets.http11 import Request

__all__ = ["Recordings", "is_recording"]

MOST_ANSWER_BYTES: Final = 8 << 20
JOIN_S: Final = 120.0
_PATH: Final = re.compile(r"/recordings/([0-9a-f]{1,32}|last)/0")
_RANGE: Final = re.compile(r"bytes=(\d{1,15})-(\d{0,15})")


def is_recording(path: str) -> bool:
    """Returns whether a path is below that of recordings."""
    return path.startswith("/recordings/")


class Recordings:
    """The recordings of a session.

    Args:
        folder: has the segments; the joined files are beside it.
        starting: is entered while a process runs that nobody else may wait for.
    """

    def __init__(
        self, folder: Path, starting: Callable[[], AbstractContextManager[None]] = nullcontext
    ) -> None:
        self._folder = folder
        self._starting = starting
        self._joining = asyncio.Lock()
        self._in_memory: tuple[str, int] | None = None
        """The name of a run, and the descriptor of its file."""

    async def respond(self, path: str, request: Request) -> Response:
        """Answers a request."""
        named = _PATH.fullmatch(path)
        if named is None:
            return _text(HTTPStatus.NOT_FOUND, "A recording is at /recordings/<run>/0.")
        wanted = _RANGE.fullmatch(request.headers.get("Range", "bytes=0-"))
        if wanted is None:
            return _text(
                HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE, "One range is answered: bytes=N- or bytes=N-M."
            )
        begin, end = int(wanted[1]), int(wanted[2]) if wanted[2] else None
        if begin == 0:
            async with self._joining:
                problem = await self._join(named[1])
            if problem is not None:
                return problem
        return await asyncio.to_thread(_part, self._joined(named[1]), begin, end)

    def _joined(self, run: str) -> Path:
        if self._in_memory is not None and self._in_memory[0] == run:
            return _path_of(self._in_memory[1])
        return self._folder.parent / f"joined-{run}.mcap"

    async def _join(self, run: str) -> Response | None:
        """Writes the file of a run; returns the answer if that fails."""
        if self._in_memory is not None:
            os.close(self._in_memory[1])
            self._in_memory = None
        joined = self._joined(run)
        fresh = joined.with_suffix(".new")
        code, problem = await self._write(run, fresh)
        if code == NO_ROOM:
            fresh.unlink(missing_ok=True)
            self._in_memory = run, os.memfd_create("bt-studio-recording", os.MFD_CLOEXEC)
            _, problem = await self._write(run, _path_of(self._in_memory[1]), self._in_memory[1])
        elif code == 0:
            fresh.rename(joined)
        return problem

    async def _write(self, run: str, out: Path, *descriptors: int) -> tuple[int | None, Response | None]:
        """Writes the file of a run; returns the status of the process, and the answer if it failed."""
        with self._starting():
            return await self._run(run, out, *descriptors)

    async def _run(self, run: str, out: Path, *descriptors: int) -> tuple[int | None, Response | None]:
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-m",
            "executor.recorder.joining",
            str(self._folder),
            run,
            str(out),
            stderr=asyncio.subprocess.PIPE,
            pass_fds=descriptors,
        )
        try:
            _, text = await asyncio.wait_for(process.communicate(), JOIN_S)
        except TimeoutError:
            process.kill()
            await process.wait()
            return None, _text(HTTPStatus.CONFLICT, "The recording took too long to join.")
        problem = None
        if process.returncode == NOT_RECORDED:
            problem = _text(HTTPStatus.NOT_FOUND, f"There is no recording of a run {run}.")
        elif process.returncode:
            reason = text.decode(errors="replace")[-500:] or "There is no room for it."
            problem = _text(HTTPStatus.CONFLICT, f"The recording cannot be joined: {reason}")
        return process.returncode, problem


def _path_of(descriptor: int) -> Path:
    return Path(f"/proc/self/fd/{descriptor}")


def _part(joined: Path, begin: int, end: int | None) -> Response:
    try:
        with joined.open("rb") as file:
            total = file.seek(0, 2)
            if begin >= total:
                return _text(HTTPStatus.REQUESTED_RANGE_NOT_SATISFIABLE, f"It has {total} bytes.")
            file.seek(begin)
            most = MOST_ANSWER_BYTES if end is None else min(MOST_ANSWER_BYTES, max(0, end - begin + 1))
            body = file.read(most)
            tag = f'"{joined.stat().st_mtime_ns:x}-{total:x}"'
    except FileNotFoundError:
        return _text(HTTPStatus.NOT_FOUND, "Ask for the beginning of the recording first.")
    headers = Headers(
        {
            "Content-Type": "application/octet-stream",
            "Content-Length": str(len(body)),
            "Content-Range": f"bytes {begin}-{begin + len(body) - 1}/{total}",
            "ETag": tag,
            "X-Content-Type-Options": "nosniff",
        }
    )
    return Response(HTTPStatus.PARTIAL_CONTENT, HTTPStatus.PARTIAL_CONTENT.phrase, headers, body)


def _text(status: HTTPStatus, text: str) -> Response:
    body = f"{text}\n".encode()
    headers = Headers({"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body))})
    return Response(status, status.phrase, headers, body)
