"""Which test files a tree has, and the digest of its content."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

PAGE: Final = "frontend"
# Folders that hold no source; those whose names begin with a dot, and `var` of the root, are left out too.
_MADE: Final = {"__pycache__", "node_modules", "dist", "coverage"}
# They need root and images, and `make test-docker` runs them.
_APART: Final = "tests/docker"


class WrongInputError(Exception):
    """An input of the user cannot be used; the text is one sentence."""


def find(root: Path, names: Sequence[str]) -> list[str]:
    """Returns the test files that are named, or are in named folders; all without names.

    Raises:
        WrongInputError: a name stands for no test file.
    """
    if not names:
        return [file for file in _tests(root, root) if not file.startswith(f"{_APART}/")]
    found: dict[str, None] = {}
    for name in names:
        path = (root / name).resolve()
        if not path.exists():
            raise WrongInputError(f"{name} does not exist.")
        if not path.is_relative_to(root.resolve()):
            raise WrongInputError(f"{name} is outside of {root}.")
        files = list(_tests(root, path))
        if not files:
            raise WrongInputError(f"{name} {'holds' if path.is_dir() else 'is'} no test file.")
        found |= dict.fromkeys(files)
    return list(found)


def is_of_page(file: str) -> bool:
    """Returns whether vitest runs a test file."""
    return file.startswith(f"{PAGE}/")


def digest(root: Path) -> str:
    """Returns the digest of all sources of a tree."""
    whole = hashlib.sha256()
    for path in _sources(root, root):
        whole.update(f"{path.relative_to(root)}\0".encode(errors="surrogateescape"))
        whole.update(hashlib.sha256(path.read_bytes()).digest())
    return whole.hexdigest()[:16]


def _tests(root: Path, place: Path) -> Iterator[str]:
    root = root.resolve()
    for path in _sources(root, place) if place.is_dir() else [place]:
        file = path.resolve().relative_to(root).as_posix()
        is_python = path.name.startswith("test_") and path.suffix == ".py" and file.startswith("tests/")
        is_page = is_of_page(file) and path.name.endswith((".test.ts", ".test.tsx"))
        if is_python or is_page:
            yield file


def _sources(root: Path, place: Path) -> Iterator[Path]:
    for folder, folders, names in os.walk(place):
        is_root = Path(folder) == root
        folders[:] = sorted(
            name
            for name in folders
            if not (name.startswith(".") or name in _MADE or name.endswith(".egg-info"))
            and not (is_root and name == "var")
        )
        yield from (path for name in sorted(names) if (path := Path(folder, name)).is_file())
