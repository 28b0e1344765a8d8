"""Leaves packages out of a lock: `python without.py requirements.lock web.without > web.lock`.

Both images are installed from the one lock of the project, so that no version differs between them; each
leaves out what only the other one needs. A name in the list may end in `*`; one that matches nothing
is an error.
"""

from __future__ import annotations

import fnmatch
import re
import sys
from pathlib import Path


def without(lock: str, patterns: list[str]) -> str:
    """The lock less the packages that match.

    Raises:
        ValueError: a pattern matches no package.
    """
    blocks = re.split(r"(?m)^(?=[A-Za-z0-9])", lock)
    names = [re.match(r"[A-Za-z0-9._-]*", block)[0] for block in blocks]  # type: ignore[index]
    idle = [pattern for pattern in patterns if not fnmatch.filter(names, pattern)]
    if idle:
        raise ValueError(f"the lock has no package {', '.join(idle)}")
    kept = zip(names, blocks, strict=True)
    return "".join(block for name, block in kept if not any(fnmatch.fnmatch(name, p) for p in patterns))


def read_patterns(text: str) -> list[str]:
    """The names of a list, one a line; `#` begins a comment."""
    return [name for line in text.splitlines() if (name := line.partition("#")[0].strip())]


if __name__ == "__main__":
    lock_file, list_file = (Path(argument) for argument in sys.argv[1:3])
    sys.stdout.write(without(lock_file.read_text(), read_patterns(list_file.read_text())))
