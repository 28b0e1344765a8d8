"""Finds the files of robots in a folder; only text is looked at, nothing of it is expanded."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

SUFFIXES: Final = (".urdf", ".xacro", ".sdf")
MOST_BYTES: Final = 4 << 20
"""Bytes at the beginning of a file that are looked at."""
_ROBOT: Final = re.compile(r"<robot\b[^>]*\sname\s*=")
_ARGUMENT: Final = re.compile(r"<xacro:arg\b[^>]*>")
_ATTRIBUTE: Final = re.compile(r"""\b(name|default)\s*=\s*(?:"([^"]*)"|'([^']*)')""")
_COMMENT: Final = re.compile(r"<!--.*?-->", re.DOTALL)


def read_start(path: Path) -> str:
    """Returns the beginning of a file as text, without comments."""
    with path.open("rb") as file:
        return _COMMENT.sub("", file.read(MOST_BYTES).decode("utf-8", "replace"))


def robots_in(source: Path) -> dict[Path, bool]:
    """Returns the files of robots in a folder, and of each whether no other file includes it."""
    found = sorted(
        path
        for path in source.rglob("*")
        if path.suffix in (*SUFFIXES, ".world") and path.is_file() and not path.is_symlink()
    )
    texts = {path: read_start(path) for path in found}
    robots = [path for path, text in texts.items() if is_robot(path, text)]
    return {path: not _is_included(path, texts) for path in robots}


def is_robot(path: Path, text: str) -> bool:
    """Returns whether a text is that of a robot, rather than of a part or of a world."""
    if path.suffix in (".sdf", ".world"):
        return "<model" in text and "<world" not in text
    return _ROBOT.search(text) is not None


def arguments_of(text: str) -> dict[str, str | None]:
    """Returns the arguments of macros that a file declares, each with its default; None if it has none."""
    found: dict[str, str | None] = {}
    for element in _ARGUMENT.findall(text):
        given = {name: one or other for name, one, other in _ATTRIBUTE.findall(element)}
        if "name" in given:
            found.setdefault(given["name"], given.get("default"))
    return found


def _is_included(path: Path, texts: dict[Path, str]) -> bool:
    name = f"model://{path.parent.name}" if path.name == "model.sdf" else path.name
    return any(name in text for other, text in texts.items() if other != path)
