"""Lines that a run without a browser prints."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["mismatch_line"]


def mismatch_line(topic: str, message: str, hint: str, files: Mapping[str, bytes]) -> str:
    """Returns the line about a topic whose ends do not match.

    It begins with the first place in the project's Python that names the topic, with or without its slash.
    """
    name = re.compile(rf"""(["'])/?{re.escape(topic.removeprefix("/"))}\1""")
    for path, raw in sorted(files.items()):
        if path.endswith(".py"):
            for number, line in enumerate(raw.decode("utf-8", "replace").splitlines(), 1):
                if name.search(line):
                    return f"{path}:{number}:1: {topic}: {message} {hint}"
    return f"{topic}: {message} {hint}"
