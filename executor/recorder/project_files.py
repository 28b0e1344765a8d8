"""Reads the files of the application that runs, as they are attached to its recording."""

from __future__ import annotations

import json
import os
import stat
from pathlib import Path
from typing import Final

__all__ = ["project_files", "project_name"]

MOST_FILES: Final = 500
MOST_BYTES: Final = 256 << 10
LONGEST_NAME: Final = 200


def project_files(folder: str) -> dict[str, bytes]:
    """Returns the regular files below a folder by their names in a recording, at most 256 KB in all.

    Users' code can write there, so links are not followed, and sizes are counted while reading.
    """
    files: dict[str, bytes] = {}
    left = MOST_BYTES
    for place, folders, names in os.walk(folder):
        folders[:] = sorted(name for name in folders if name != "__pycache__")
        for name in sorted(names):
            data = _read(Path(place) / name, left)
            if data is None or len(files) >= MOST_FILES:
                continue
            left -= len(data)
            files[f"project/{(Path(place) / name).relative_to(folder).as_posix()}"] = data
    return files


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
