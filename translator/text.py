"""Text that all formats of BT Studio can hold: no control characters, no lone surrogates."""

from __future__ import annotations

import hashlib
import re
from functools import lru_cache
from typing import Final
from xml.parsers import expat

# XML 1.0 has no way to write these, not even as a character reference.
_FORBIDDEN = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
# The characters that BehaviorTree.CPP 4.9+ forbids in the IDs of trees and nodes; they would end a path or a
# tag.
_BAD_IN_ID = re.compile(r"[\s/\\:*?|.<>&\"'\x00-\x1f]")


def is_clean(text: str) -> bool:
    """Returns whether XML can hold the text."""
    return _FORBIDDEN.search(text) is None


def clean(text: str) -> str:
    """Returns the text with characters that XML cannot hold replaced by U+FFFD."""
    return _FORBIDDEN.sub("\ufffd", text)


def bad_character(identifier: str) -> str | None:
    """Returns the first character that the ID of a tree or a node must not have."""
    found = _BAD_IN_ID.search(identifier) or _FORBIDDEN.search(identifier)
    return found.group() if found else None


def is_valid_id(identifier: str) -> bool:
    """Returns whether the text can be the ID of a tree or the type of a node."""
    return bool(identifier) and bad_character(identifier) is None and identifier not in {"root", "Root"}


def safe_name(identifier: str) -> str:
    """Returns a file name for an ID that cannot be one; different IDs give different names."""
    readable = re.sub(r"[^\w-]+", "_", clean(identifier)).strip("_")[:60]
    digest = hashlib.sha256(identifier.encode("utf-8", "replace")).hexdigest()[:8]
    return f"{readable or 'tree'}_{digest}"


@lru_cache(maxsize=4096)
def is_xml_name(name: str) -> bool:
    """Returns whether the text can be an XML tag or attribute; asks expat, which later reads the file."""
    if ":" in name or not name or re.search(r"[\s<>/=\"'&?!]", name) or not is_clean(name):
        return False
    try:
        expat.ParserCreate("utf-8").Parse(f"<{name}/>".encode(), True)  # noqa: FBT003
    except expat.ExpatError:
        return False
    return True


_SHOWN: Final = 80


def excerpt(code: str, offset: int) -> str:
    """Returns the 80 characters of a script round an offset, as messages show them."""
    start = max(0, min(offset - _SHOWN // 2, len(code) - _SHOWN))
    before, after = "…" if start else "", "…" if start + _SHOWN < len(code) else ""
    return f"{before}{code[start : start + _SHOWN]}{after}"
