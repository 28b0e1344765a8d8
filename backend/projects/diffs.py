"""Differences between two revisions."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

    from backend.projects.queries import StoredFile

# difflib takes quadratic time on long files: beyond this only the fact of a change is told.
MAX_LINES: Final = 5000


def diff(older: Mapping[str, StoredFile], newer: Mapping[str, StoredFile]) -> list[dict[str, Any]]:
    """One entry for each file that differs, in the order of paths."""
    return [
        {"path": path, "change": _kind(before, after), "diff": _text(path, before, after)}
        for path in sorted({*older, *newer})
        if _sha(before := older.get(path)) != _sha(after := newer.get(path))
    ]


def _sha(file: StoredFile | None) -> str:
    return file.sha256 if file else ""


def _kind(before: StoredFile | None, after: StoredFile | None) -> str:
    if before is None:
        return "added"
    return "changed" if after else "removed"


def _text(path: str, before: StoredFile | None, after: StoredFile | None) -> str | None:
    texts = [file.text if file else "" for file in (before, after)]
    if texts[0] is None or texts[1] is None:
        return None
    old, new = (text.splitlines(keepends=True) for text in texts if text is not None)
    if max(len(old), len(new)) > MAX_LINES:
        return None
    names = (path if before else "/dev/null", path if after else "/dev/null")
    lines = difflib.unified_diff(old, new, names[0], names[1])
    return "".join(
        line if line.endswith("\n") else line + "\n\\ No newline at end of file\n" for line in lines
    )
