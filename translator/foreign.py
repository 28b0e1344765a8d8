"""Which files belong to a tool rather than to a project: `.git/`, `.vscode/` and the like.

Tools run what such folders say (hooks, tasks, settings) as soon as somebody opens the project with them, so
they are neither taken in nor handed on: imports, exports and packages leave them out, and nobody saves them.
This is the one place that says which they are.
"""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["is_of_tool", "without_tools"]

_SHORT_NAME = re.compile(r"git~\d+")
"""How Windows calls `.git` in eight letters."""


def is_of_tool(path: str) -> bool:
    """Whether a path lies in a folder that begins with a dot, or is a repository's `.git` itself."""
    *folders, name = map(_as_disks_see_it, path.split("/"))
    hidden = any(folder.startswith(".") for folder in folders)
    return hidden or name == ".git" or any(_SHORT_NAME.fullmatch(part) for part in (*folders, name))


def without_tools(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files of the project alone."""
    return {path: content for path, content in files.items() if not is_of_tool(path)}


def _as_disks_see_it(name: str) -> str:
    """Some disks know neither letters of two sizes nor characters that have no shape."""
    shown = "".join(char for char in name if unicodedata.category(char) != "Cf")
    return unicodedata.normalize("NFKC", shown).casefold().rstrip(" .")
