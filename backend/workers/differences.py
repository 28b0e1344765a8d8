"""Differences between two states of a project, as unified diffs."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

# difflib takes quadratic time on long files: beyond this only the fact of a change is reported.
MAX_LINES: Final = 5000


def diff(older: Mapping[str, str | None], newer: Mapping[str, str | None]) -> list[dict[str, Any]]:
    """Returns one entry for each path of either state, in order.

    Args:
        older: files that differ, by path; None stands for a file that is not text.
        newer: the same files in the newer state.
    """
    return [
        {"path": path, "change": _kind(path, older, newer), "diff": _text(path, older, newer)}
        for path in sorted({*older, *newer})
    ]


def _kind(path: str, older: Mapping[str, str | None], newer: Mapping[str, str | None]) -> str:
    if path not in older:
        return "added"
    return "changed" if path in newer else "removed"


def _text(path: str, older: Mapping[str, str | None], newer: Mapping[str, str | None]) -> str | None:
    before, after = older.get(path, ""), newer.get(path, "")
    if before is None or after is None:
        return None
    old, new = before.splitlines(keepends=True), after.splitlines(keepends=True)
    if max(len(old), len(new)) > MAX_LINES:
        return None
    names = (path if path in older else "/dev/null", path if path in newer else "/dev/null")
    return "".join(
        line if line.endswith("\n") else line + "\n\\ No newline at end of file\n"
        for line in difflib.unified_diff(old, new, names[0], names[1])
    )
