"""Recognises files that belong to a tool rather than to a project, such as `.git/` and `.vscode/`.

Tools execute the hooks, tasks and settings in such folders as soon as a user opens the project with them. So
imports, exports and packages leave them out, and they cannot be saved. Only this module defines them.
"""

from __future__ import annotations

import re
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["is_of_tool", "without_tools"]

_SHORT_NAME = re.compile(r"git~\d+")
"""The short name of `.git` on Windows, which has up to eight letters."""


def is_of_tool(path: str) -> bool:
    """Returns whether a path lies in a folder that begins with a dot, or is a repository's `.git` itself."""
    *folders, name = map(_as_disks_see_it, path.split("/"))
    hidden = any(folder.startswith(".") for folder in folders)
    return hidden or name == ".git" or any(_SHORT_NAME.fullmatch(part) for part in (*folders, name))


def without_tools(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """Returns only the files of the project."""
    return {path: content for path, content in files.items() if not is_of_tool(path)}


def _as_disks_see_it(name: str) -> str:
    """Normalises a path as file systems do that ignore the case of letters and invisible characters."""
    shown = "".join(char for char in name if unicodedata.category(char) != "Cf")
    return unicodedata.normalize("NFKC", shown).casefold().rstrip(" .")
