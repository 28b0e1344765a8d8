"""Turns a log of a robot into a recording, in a child with limits: nothing of it is read in the web server.

The child is `executor.recorder.outside`. It is known by its command alone, as the executor itself is.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from typing import IO, TYPE_CHECKING, Final

import msgspec

from backend.config.environment import REPOSITORY, environment
from backend.runs.errors import LogRefusedError, LogsUnavailableError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["convert", "require_converter"]

DEADLINE_S: Final = 70.0  # the child ends itself after 60 s
COPY_BYTES: Final = 1 << 20
_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH")
_SMALLER: Final = "Cut the part of the log that matters."


class _Told(msgspec.Struct):
    """The last line of the child: the facts of the recording, or the reason of the failure."""

    messages: int = 0
    message: str = ""
    hint: str = ""
    code: str = ""
    place: int = 0


def require_converter() -> None:
    """Refuses logs where no process may read them.

    Raises:
        LogsUnavailableError: files of users are read in containers on this server, and none reads logs.
    """
    if environment().is_team or environment().has_containers:
        raise LogsUnavailableError(
            "This server does not read logs of robots.",
            hint="Open the log in an IDE on your own computer, or look at it after `bt-studio convert`.",
        )


def convert(log: IO[bytes], name: str, folder: Path) -> Path:
    """Returns the recording that was made of a log, in an empty folder.

    Raises:
        LogRefusedError: it is no log that can be read, or it exceeds a limit.
    """
    source, target = folder / "log", folder / "run.mcap"
    with source.open("wb") as out:
        shutil.copyfileobj(log, out, COPY_BYTES)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "executor.recorder.outside", str(source), str(target), name],
            cwd=REPOSITORY,
            env={key: os.environ[key] for key in _PASSED if key in os.environ},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=DEADLINE_S,
            check=False,
        )
        told = msgspec.json.decode(done.stdout, type=_Told)
    except subprocess.TimeoutExpired as error:
        raise LogRefusedError(
            f"{name}: reading it took too long.", hint=_SMALLER, reason="too_long"
        ) from error
    except msgspec.DecodeError as error:
        text = f"{name}: reading it took more time or memory than a log may take."
        raise LogRefusedError(text, hint=_SMALLER, reason="too_large") from error
    if told.code:
        text = f"{name}:{told.place}: {told.message}"
        raise LogRefusedError(text, hint=told.hint, reason=told.code, place=told.place)
    return target
