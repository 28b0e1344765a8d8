"""Leaves packages out of a lock: `python without.py requirements.lock web.without > web.lock`.

Both images are installed from the one lock of the project, so that no version differs between them; each
leaves out what only the other one needs. A name in the list may end in `*`.
"""

from __future__ import annotations

import fnmatch
import re
import sys
from pathlib import Path


def without(lock: str, patterns: list[str]) -> str:
    """Returns the lock without the packages that match."""
    blocks = re.split(r"(?m)^(?=[A-Za-z0-9])", lock)
    return "".join(block for block in blocks if not _matches(name_of(block), patterns))


def name_of(block: str) -> str:
    """Returns the package that a block of the lock is about; empty for the text before the first package."""
    found = re.match(r"[A-Za-z0-9._-]+", block)
    return found[0] if found else ""


def _matches(name: str, patterns: list[str]) -> bool:
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns)


def read_patterns(text: str) -> list[str]:
    """Returns the names in a list, one on each line; `#` begins a comment."""
    return [name for line in text.splitlines() if (name := line.partition("#")[0].strip())]


if __name__ == "__main__":
    lock_file, list_file = (Path(argument) for argument in sys.argv[1:3])
    sys.stdout.write(without(lock_file.read_text(), read_patterns(list_file.read_text())))
