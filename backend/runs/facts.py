"""Reads the facts of a run from its recording, in a child with limits; this process never reads the file.

The child is `executor.recorder.summary`, known by its command alone. Its picture is decoded and encoded again
in the pool of workers. What both say is compared with bounds before it is used.
"""

from __future__ import annotations

import logging
import os
import subprocess
import sys
from typing import IO, TYPE_CHECKING, Annotated, Final

import msgspec
from msgspec import Meta

from backend.config.environment import REPOSITORY
from backend.core.problems import StudioError
from backend.runs.choices import Result
from backend.runs.length import DamagedError, length_of
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["Facts", "facts_of", "join_newest"]

log = logging.getLogger(__name__)

DEADLINE_S: Final = 70.0  # the child ends itself after 60 s of processor time
LONGEST_NS: Final = 10_000_000 * 1_000_000_000
LARGEST_THUMBNAIL_BYTES: Final = 128 << 10
_TYPES: Final = frozenset({"image/jpeg", "image/svg+xml"})
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH")
_Row = Annotated[list[float], Meta(max_length=6)]
_Time = Annotated[int, Meta(ge=0, le=LONGEST_NS)]


class _Told(msgspec.Struct):
    """The last word of the child."""

    messages: int = 0
    from_ns: _Time = 0
    to_ns: _Time = 0
    ticks: int = 0
    result: Result = Result.RUNNING
    picture: bytes = b""
    rows: Annotated[list[Annotated[list[int], Meta(min_length=2, max_length=2)]], Meta(max_length=200)] = []
    trail: Annotated[list[Annotated[_Row, Meta(min_length=2)]], Meta(max_length=1000)] = []
    boxes: Annotated[list[Annotated[_Row, Meta(min_length=6)]], Meta(max_length=1000)] = []
    xml: bytes = b""
    run: Annotated[str, Meta(pattern=r"^[0-9a-f]{0,32}$")] = ""
    code: str = ""
    message: str = ""
    place: int = 0


class Facts(msgspec.Struct):
    """The facts that the server found out about a run.

    Attributes:
        start_s, length_s: the time of the first message, and from it to the last one, in s.
        result: how it ended.
        thumbnail, thumbnail_type: a small picture and its media type, or nothing.
        xml: the tree of a log of BehaviorTree.CPP, or nothing.
        run: the name of a joined run.
    """

    start_s: float
    length_s: float
    result: Result = Result.RUNNING
    thumbnail: bytes = b""
    thumbnail_type: str = ""
    xml: bytes = b""
    run: str = ""


def facts_of(file: IO[bytes], owner: str) -> Facts:
    """Returns the facts of a recording. If reading takes too long, only its times are known.

    Args:
        file: the recording; it has a descriptor.
        owner: the user to whom the pool charges the work.

    Raises:
        DamagedError: it is no recording.
    """
    file.seek(0)
    told = _told(["file", "recording"], stdin=file)
    if told is None:
        size = file.seek(0, os.SEEK_END)
        return Facts(*length_of(lambda at, length: _read(file, at, length), size))
    return _facts(told, owner)


def join_newest(folder: Path, out: Path, owner: str) -> Facts | None:
    """Joins the segments of the last run in a session's folder; returns its facts, or None without a run.

    Raises:
        DamagedError: a segment is damaged, or joining takes too long.
    """
    told = _told(["newest", str(folder), str(out)], stdin=subprocess.DEVNULL)
    if told is None:
        raise DamagedError("joining it takes more time or memory than a run may take")
    return None if told.code == "not_recorded" else _facts(told, owner)


def _facts(told: _Told, owner: str) -> Facts:
    if told.code:
        raise DamagedError(f"{told.message} (byte {told.place})")
    if not told.messages or told.to_ns < told.from_ns:
        raise DamagedError("it has no messages")
    kind, small = _thumbnail(told, owner)
    times = told.from_ns * 1e-9, (told.to_ns - told.from_ns) * 1e-9
    return Facts(*times, told.result, small, kind, told.xml, told.run)


def _thumbnail(told: _Told, owner: str) -> tuple[str, bytes]:
    """Returns type and bytes of a small picture; a run without one is kept all the same."""
    drawn = {"boxes": told.boxes, "trail": told.trail, "rows": told.rows}
    try:
        made = pool().ask(owner, "thumbnail", picture=told.picture, **drawn).result(DEADLINE_S)
    except (StudioError, TimeoutError) as error:
        log.info("a run has no thumbnail: %s", error)
        return "", b""
    if made["type"] not in _TYPES or len(made["data"]) > LARGEST_THUMBNAIL_BYTES:
        return "", b""
    return made["type"], made["data"]


def _told(arguments: list[str], stdin: IO[bytes] | int) -> _Told | None:
    """Returns the facts that the child printed; None if it printed nothing or impossible values."""
    try:
        done = subprocess.run(
            [sys.executable, "-m", "executor.recorder.summary", *arguments],
            cwd=REPOSITORY,
            env={key: os.environ[key] for key in _PASSED if key in os.environ},
            stdin=stdin,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=DEADLINE_S,
            check=False,
        )
        return msgspec.json.decode(done.stdout, type=_Told)
    except (subprocess.TimeoutExpired, msgspec.DecodeError) as error:
        log.info("a recording was not read: %s", error)
        return None


def _read(file: IO[bytes], at: int, length: int) -> bytes:
    file.seek(at)
    return file.read(length)
