"""Gives the recording of a run over HTTP, as one file in parts: `GET /recordings/<run>/<branch>`.

`last` instead of the name of a run is the one that was recorded last.

A request for the begin joins the segments again, in a process of its own; requests for later parts read the
same file, which its `ETag` names. One answer holds at most 8 MiB, so that no run is held in memory.
"""

from __future__ import annotations

import asyncio
import re
import sys
from http import HTTPStatus
from typing import TYPE_CHECKING, Final

from websockets.datastructures import Headers
from websockets.http11 import Response

from executor.recorder.joining import NOT_RECORDED

if TYPE_CHECKING:
    from pathlib import Path

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
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._joining = asyncio.Lock()

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
        joined = self._folder.parent / f"joined-{named[1]}.mcap"
        if begin == 0:
            async with self._joining:
                problem = await self._join(named[1], joined)
            if problem is not None:
                return problem
        return await asyncio.to_thread(_part, joined, begin, end)

    async def _join(self, run: str, joined: Path) -> Response | None:
        """Writes the file of a run; returns the answer if that fails."""
        fresh = joined.with_suffix(".new")
        process = await asyncio.create_subprocess_exec(
            sys.executable,
            "-m",
            "executor.recorder.joining",
            str(self._folder),
            run,
            str(fresh),
            stderr=asyncio.subprocess.PIPE,
        )
        try:
            _, text = await asyncio.wait_for(process.communicate(), JOIN_S)
        except TimeoutError:
            process.kill()
            await process.wait()
            return _text(HTTPStatus.CONFLICT, "The recording took too long to join.")
        if process.returncode == NOT_RECORDED:
            return _text(HTTPStatus.NOT_FOUND, f"There is no recording of a run {run}.")
        if process.returncode:
            reason = text.decode(errors="replace")[-500:]
            return _text(HTTPStatus.CONFLICT, f"The recording cannot be joined: {reason}")
        fresh.rename(joined)
        return None


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
        return _text(HTTPStatus.NOT_FOUND, "Ask for the begin of the recording first.")
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
