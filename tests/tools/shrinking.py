"""A list of known exceptions that only shrinks: what a check still finds, one entry a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path


def compare(found: list[str], file: Path, arguments: list[str], *, new: str, gone: str) -> int:
    """Compares what is found with the list and prints the differences; returns 1 if there are any.

    With `--write`, the list is written instead, unless it would grow.
    """
    known = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    if "--write" in arguments and (len(found) <= len(known) or not file.exists()):
        file.write_text("".join(f"{entry}\n" for entry in found), encoding="utf-8")
        return 0
    added, left = sorted(set(found) - set(known)), sorted(set(known) - set(found))
    for entry in added:
        print(f"{entry}: {new}")
    for entry in left:
        print(f"{entry}: {gone}")
    return 1 if added or left else 0
