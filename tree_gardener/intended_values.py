"""Finds the right form of a value of the wrong type: true for `yes`, a number for `"0.22"`."""

from __future__ import annotations

import json
import re
from typing import Any, Final, Literal

__all__ = ["Wanted", "intended", "sentence"]

Wanted = Literal["boolean", "number", "integer", "text"]

_SENTENCES: Final[dict[Wanted, str]] = {
    "boolean": "must be true or false",
    "number": "must be a number",
    "integer": "must be a whole number",
    "text": "must be text",
}
# YAML 1.1 reads these as true and false; the core schema of YAML 1.2 reads them as text.
_TRUE: Final = frozenset({"true", "yes", "on", "y"})
_FALSE: Final = frozenset({"false", "no", "off", "n"})
_NUMBER: Final = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_WHOLE: Final = re.compile(r"[-+]?[0-9]+")


def intended(value: Any, wanted: Wanted) -> str | None:
    """Returns what to write for a value so that it has the wanted type, or None if nobody can know."""
    if wanted == "text":
        return json.dumps(_plain(value)) if isinstance(value, (bool, int, float)) else None
    if not isinstance(value, str):
        return None
    word = value.strip()
    if wanted == "boolean":
        return "true" if word.lower() in _TRUE else "false" if word.lower() in _FALSE else None
    number = re.sub(r"(?<=[0-9])_+(?=[0-9])", "", word)
    return number if (_NUMBER if wanted == "number" else _WHOLE).fullmatch(number) else None


def sentence(value: Any, wanted: Wanted) -> str:
    """Returns what is wrong with a value that is not of the wanted type, and what to write if known."""
    write = intended(value, wanted)
    return _SENTENCES[wanted] + (f"; write {write}" if write is not None else "")


def _plain(value: float) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else str(value)
