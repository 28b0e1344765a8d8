"""Reads the files of the application that runs, as they are attached to its recording."""

from __future__ import annotations

import json
import os
import stat
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["PROJECT", "project_files", "project_name"]

PROJECT: Final = "project/"
"""Begins the names of the project's files in a recording."""

MOST_FILES: Final = 500
MOST_BYTES: Final = 256 << 10
LONGEST_NAME: Final = 200
MOST_LOOKED_AT: Final = 20_000
# The engine is known by its version.
LEFT_OUT: Final = {"__pycache__", "tree_gardener"}


def project_files(folder: str, universe: str = "") -> dict[str, bytes]:
    """Returns the regular files below a folder by their names in a recording, at most 256 KB in all.

    The diagrams come first, since the tree as it ran is shown by them; the engine is left out. Users' code
    can write there, so links are not followed, and sizes are counted while reading. The document of the
    universe, which has the project's robots in it, comes last.
    """
    files: dict[str, bytes] = {}
    left = MOST_BYTES
    for name in sorted(islice(_names(folder), MOST_LOOKED_AT), key=_rank):
        data = _read(Path(folder) / name, left)
        if data is None or len(files) >= MOST_FILES:
            continue
        left -= len(data)
        files[f"{PROJECT}{name}"] = data
    document = universe.encode("utf-8", "replace")
    if 0 < len(document) <= left:
        files["universe.yaml"] = document
    return files


def _names(folder: str) -> Iterator[str]:
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in LEFT_OUT)
        for name in sorted(names):
            yield (Path(place) / name).relative_to(folder).as_posix()


def _rank(name: str) -> tuple[bool, str]:
    return not name.startswith("trees/"), name


def project_name(files: dict[str, bytes]) -> str:
    """Returns the name that a project's settings give it; "" without one."""
    try:
        settings = json.loads(files.get("project/project.json", b""))
    except (ValueError, RecursionError):
        return ""
    name = settings.get("name") if isinstance(settings, dict) else None
    return name[:LONGEST_NAME] if isinstance(name, str) else ""


def _read(path: Path, most: int) -> bytes | None:
    try:
        fd = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return None
    with os.fdopen(fd, "rb") as file:
        if not stat.S_ISREG(os.fstat(fd).st_mode):
            return None
        data = file.read(most + 1)
    return data if len(data) <= most else None
