"""Which names a script reads and writes, from its words alone, so that one with an error counts too."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

_TOKENS = re.compile(
    r"(?P<text>'[^']*'?|\"[^\"]*\"?)|(?P<number>\d[\w.]*)|(?P<name>[^\W\d]\w*|@\w*)\s*(?P<assign>:=|[-+*/]=|=(?!=))?"
)
_WORDS = {"true", "false"}


class ScriptNames(NamedTuple):
    """Names that a script reads from the blackboard, and names that it assigns."""

    read: tuple[str, ...]
    written: tuple[str, ...]


@lru_cache(maxsize=4096)
def script_names(code: str) -> ScriptNames:
    """Returns the names of a script, each once, in order."""
    read: dict[str, None] = {}
    written: dict[str, None] = {}
    for match in _TOKENS.finditer(code):
        name = match.group("name")
        if not name or name in _WORDS:
            continue
        assign = match.group("assign")
        if assign:
            written.setdefault(name)
        if assign is None or assign not in {":=", "="}:
            read.setdefault(name)
    return ScriptNames(tuple(read), tuple(written))
