"""Expands xacro in a child with limits. Nothing of the document is evaluated in this process.

The child has 512 MB, 10 s and an answer of at most 16 MB; it reads the folders in which packages are
searched, and opens no socket and no program.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.expansion.child import ANSWER_BYTES, MEMORY_BYTES, SECONDS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tree_gardener.packages import Packages

_PASSED: Final = ("PATH", "LANG", "LC_ALL", "PYTHONPATH")
_OF_ROBOTS: Final = ("ROS_", "GZ_", "IGN_", "GAZEBO_", "TURTLEBOT", "ROBOT_")
"""Beginnings of the names of variables that `$(env)` and `$(optenv)` see: others may be secrets."""
_WALL_S: Final = 30.0
"""How long the child may take by the wall clock on a busy machine; its processor time is less."""
_MARKS: Final = (b"<xacro:", b"${", b"$(")


class ExpandError(Exception):
    """The macros are wrong, or need too much; the place is that in the source."""

    def __init__(self, message: str, file: Path, line: int = 1) -> None:
        super().__init__(message)
        self.file = file
        self.line = line


@dataclass(frozen=True)
class Source:
    """A document, and where each of its lines comes from; without places, from the file itself."""

    text: bytes
    file: Path
    places: tuple[tuple[Path, int], ...] = ()
    notes: list[str] = field(default_factory=list)

    def place(self, line: int) -> tuple[Path, int]:
        """Returns the file and the line that a line of the document comes from."""
        if not self.places:
            return self.file, line
        return self.places[min(max(line, 1), len(self.places)) - 1]


def has_macros(file: Path, data: bytes) -> bool:
    """Returns whether a document is xacro, by its name or by what is in it."""
    return file.suffix == ".xacro" or any(mark in data for mark in _MARKS)


def expand_apart(
    file: Path,
    packages: Packages,
    arguments: Mapping[str, str] | None = None,
    *,
    is_lenient: bool = False,
) -> Source:
    """Returns the expanded document of an xacro file.

    Args:
        file: the file.
        packages: the packages that it may name.
        arguments: values of the arguments of macros.
        is_lenient: whether to leave out an include of a package that nobody has, with a note.

    Raises:
        ExpandError: the macros are wrong, or exceed a limit.
    """
    job = {
        "file": str(file),
        "places": [[place.shown, str(place.folder)] for place in packages.places],
        "installed": [[place.shown, str(place.folder)] for place in packages.installed],
        "arguments": dict(arguments or {}),
        "is_lenient": is_lenient,
    }
    try:
        code, data = _run(job)
    except subprocess.TimeoutExpired as error:
        raise ExpandError(f"the macros take more than {SECONDS} s", file) from error
    return _source(file, code, data)


def answer_of(job: Mapping[str, Any]) -> dict[str, Any] | None:
    """Returns what the child answers to a job; None if it exceeded a limit."""
    try:
        answer: dict[str, Any] = json.loads(_run(job)[1])
    except (subprocess.TimeoutExpired, ValueError, RecursionError):
        return None
    return answer


def _run(job: Mapping[str, Any]) -> tuple[int, bytes]:
    """Gives the child a job; returns its exit status and its answer."""
    environment = {
        name: value for name, value in os.environ.items() if name in _PASSED or name.startswith(_OF_ROBOTS)
    }
    with tempfile.TemporaryFile() as out:
        done = subprocess.run(
            [sys.executable, "-m", "executor.expansion"],
            input=json.dumps(job).encode(),
            stdout=out,
            stderr=subprocess.DEVNULL,
            # A library that starts a thread for each core may not, in a child without processes.
            env=environment | {"OPENBLAS_NUM_THREADS": "1"},
            timeout=_WALL_S,
            check=False,
        )
        out.seek(0)
        return done.returncode, out.read(ANSWER_BYTES + 1)


def _source(file: Path, code: int, data: bytes) -> Source:
    try:
        answer: dict[str, Any] = json.loads(data)
    except ValueError:
        if code < 0:
            raise ExpandError(f"the macros take more than {SECONDS} s", file) from None
        most = f"{MEMORY_BYTES >> 20} MB of memory or {ANSWER_BYTES >> 20} MB for the document"
        raise ExpandError(f"the macros need more than {most}", file) from None
    if "error" in answer:
        raise ExpandError(f"xacro: {answer['error']}", Path(answer["file"]), int(answer["line"]))
    files = [Path(name) for name in answer["files"]]
    places = tuple((files[number], line) for number, line in answer["lines"])
    return Source(answer["text"].encode(), file, places, list(answer["notes"]))
