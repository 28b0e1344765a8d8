"""The environment of a language server for Python, and the files outside of a project that it may name.

The same for a server on localhost and in a session's container, which share no other package. The page may
read these files, and no others. Each folder has a label, which the page sees instead of the path:

    python     the standard library
    packages   the installed packages
    typeshed   the language server's stubs of the standard library
    modules    the engine, ROS packages and stubs of messages (`library.py`)
"""

from __future__ import annotations

import os
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable

SUFFIXES: Final = (".py", ".pyi")
MAX_BYTES: Final = 2 * 1024 * 1024
# `ty` writes its stubs below its home folder when it first names one.
TYPESHED: Final = ".cache/ty/vendored/typeshed"


def environment_of(home: Path) -> dict[str, str]:
    """Returns the environment of a language server, without any variable of the program that starts it."""
    return {
        "PATH": os.defpath,
        "HOME": str(home),
        "LANG": "C.UTF-8",
        "TY_CONFIG_FILE": str(home / "ty.toml"),
        "TY_MAX_PARALLELISM": "1",
    }


def source_roots(home: Path, library: Path) -> dict[str, str]:
    """Returns the folders that may be read, by label, for a language server with this home folder."""
    # The language server names the targets of links.
    entries = library.iterdir() if library.is_dir() else ()
    linked = {f"modules/{each.name}": str(each.resolve()) for each in entries if each.is_symlink()}
    return {
        "python": sysconfig.get_path("stdlib"),
        "packages": sysconfig.get_path("purelib"),
        "typeshed": str(home / TYPESHED),
        "modules": str(library),
    } | linked


def read_source(path: str, roots: Iterable[str]) -> str | None:
    """Returns the text of a Python file below one of the folders; None for all other files."""
    try:
        real = Path(path).resolve(strict=True)
        is_below = any(real.is_relative_to(Path(root).resolve()) for root in roots)
        if not is_below or real.suffix not in SUFFIXES or not real.is_file():
            return None
        data = real.read_bytes() if real.stat().st_size <= MAX_BYTES else None
    except (OSError, ValueError, RuntimeError):  # the path has a null character, or the links form a circle
        return None
    return None if data is None else data.decode(errors="replace")
