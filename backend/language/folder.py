"""The folder that a language server reads: the Python files of a project's newest revision.

The layout:

<data>/language/projects/<id>/ty.toml          BT Studio's configuration; that of a project is not used
<data>/language/projects/<id>/files/…          the project's Python files, and nothing else
<data>/language/library-<key>/…                importable by every project: the engine, ROS messages
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import sysconfig
from dataclasses import dataclass
from pathlib import Path
from threading import Lock
from typing import TYPE_CHECKING, Final
from uuid import uuid4

from backend.config.environment import REPOSITORY, environment
from backend.language import message_stubs, rclpy_types
from backend.language.library import configuration

if TYPE_CHECKING:
    from collections.abc import Mapping
    from uuid import UUID

SUFFIXES: Final = (".py", ".pyi")
_lock: Final = Lock()


@dataclass(frozen=True, slots=True)
class Sync:
    """The changes that a synchronisation made on the disk, by path in the project."""

    created: tuple[str, ...]
    changed: tuple[str, ...]
    deleted: tuple[str, ...]


class Folder:
    """The folder of one project, which several language servers can read."""

    def __init__(self, project_id: UUID) -> None:
        self.home = environment().data_dir / "language" / "projects" / str(project_id)
        self.files = self.home / "files"

    def prepare(self) -> None:
        """Makes the folder with its configuration."""
        (self.files / "actions").mkdir(parents=True, exist_ok=True)
        text = configuration(str(self.files), str(library()), sys.executable)
        _write(self.home / "ty.toml", text.encode())

    def sync(self, contents: Mapping[str, bytes]) -> Sync:
        """Makes the folder contain exactly the Python files among these files."""
        wanted = python_of(contents)
        created: list[str] = []
        changed: list[str] = []
        deleted: list[str] = []
        with _lock:
            for path in self._paths() - set(wanted):
                (self.files / path).unlink(missing_ok=True)
                deleted.append(path)
            for path, data in wanted.items():
                target = self.files / path
                before = target.read_bytes() if target.is_file() else None
                if before == data:
                    continue
                target.parent.mkdir(parents=True, exist_ok=True)
                _write(target, data)
                (created if before is None else changed).append(path)
        return Sync(tuple(sorted(created)), tuple(sorted(changed)), tuple(sorted(deleted)))

    def remove(self) -> None:
        """Removes the folder of a deleted project."""
        shutil.rmtree(self.home, ignore_errors=True)

    def _paths(self) -> set[str]:
        return {p.relative_to(self.files).as_posix() for p in self.files.rglob("*") if p.is_file()}


def python_of(contents: Mapping[str, bytes]) -> dict[str, bytes]:
    """Returns the Python files of a project."""
    return {path: data for path, data in contents.items() if path.endswith(SUFFIXES)}


def library() -> Path:
    """Returns the folder of the libraries that every project can import; makes it if it is missing."""
    with _lock:
        site_packages = Path(sysconfig.get_path("purelib"))
        folder = environment().data_dir / "language" / f"library-{_library_key(site_packages)}"
        if not folder.is_dir():
            _make_library(site_packages, folder)
        return folder


def _library_key(site_packages: Path) -> str:
    """Returns a key that changes with the interpreter, the installed packages and the stub generator."""
    installed = sorted(entry.name for entry in os.scandir(site_packages) if entry.name.endswith("-info"))
    how = b"".join(Path(path).read_bytes() for path in (message_stubs.__file__, rclpy_types.__file__))
    return hashlib.sha256(repr((sys.prefix, str(REPOSITORY), installed)).encode() + how).hexdigest()[:16]


def _make_library(site_packages: Path, folder: Path) -> None:
    partial = folder.with_name(f"{folder.name}.{uuid4().hex}")
    # In a separate process: it parses hundreds of modules, and only one thread at a time may parse Python.
    command = (sys.executable, "-m", "backend.language.library", site_packages, REPOSITORY, partial)
    subprocess.run(command, cwd=REPOSITORY, check=True)
    try:
        partial.rename(folder)
    except OSError:  # another server was faster
        shutil.rmtree(partial)


def _write(path: Path, data: bytes) -> None:
    """Writes a file atomically, so that a reader sees either the old or the new bytes."""
    partial = path.with_name(f".{path.name}.{uuid4().hex}.partial")
    partial.write_bytes(data)
    partial.replace(path)
