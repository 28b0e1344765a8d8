"""Writes the files of a project into the folder of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

__all__ = ["write_files"]


def write_files(folder: Path, files: Mapping[str, bytes]) -> None:
    """Writes files into a folder, each at its path.

    Raises:
        ValueError: a path is outside of the folder.
    """
    for name, data in files.items():
        path = folder / name
        if not path.resolve().is_relative_to(folder.resolve()):
            raise ValueError(f"{name!r} lies outside the project")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
