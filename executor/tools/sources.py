"""Files that a user may read beside the project: Python's own library, installed packages, and stubs.

Does the same as `backend/language/sources.py`, in the container. The page sees the labels instead of the
folders.
"""

from __future__ import annotations

import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["read_source", "source_roots"]

MAX_BYTES: Final = 2 * 1024 * 1024
_SUFFIXES: Final = (".py", ".pyi")
# `ty` writes its stubs below its home folder when it first names one.
_TYPESHED: Final = ".cache/ty/vendored/typeshed"


def source_roots(home: Path, library: Path) -> dict[str, str]:
    """Returns the folders that may be read, by label, for a language server with this home folder."""
    entries = library.iterdir() if library.is_dir() else ()
    # The language server names the targets of links.
    linked = {f"modules/{each.name}": str(each.resolve()) for each in entries if each.is_symlink()}
    return {
        "python": sysconfig.get_path("stdlib"),
        "packages": sysconfig.get_path("purelib"),
        "typeshed": str(home / _TYPESHED),
        "modules": str(library),
    } | linked


def read_source(path: str, roots: Iterable[str]) -> str | None:
    """Returns the text of a Python file below one of the folders; None for all other files."""
    try:
        real = Path(path).resolve(strict=True)
        is_below = any(real.is_relative_to(Path(root).resolve()) for root in roots)
        if not is_below or real.suffix not in _SUFFIXES or not real.is_file():
            return None
        data = real.read_bytes() if real.stat().st_size <= MAX_BYTES else None
    except (OSError, ValueError, RuntimeError):  # the path has a null character, or the links form a circle
        return None
    return None if data is None else data.decode(errors="replace")
