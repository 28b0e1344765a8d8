"""Finds bare `&` and `<` in attributes; BehaviorTree.CPP's parser accepts them, XML does not.

Repairs are found and offered; nothing is changed unless the user asks for it.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from translator.diagnostic import Diagnostic, Place, diagnostic
from translator.limits import XML_REPAIRS

if TYPE_CHECKING:
    from collections.abc import Iterator

_SKIPPED = re.compile(r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<!.*?>", re.DOTALL)
_TAG = re.compile(r"</?[^\s<>/\"'=]+")
_BARE = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#[0-9]+|#x[0-9a-fA-F]+);)|<")
_ESCAPES = {"&": "&amp;", "<": "&lt;"}


@dataclass(frozen=True, slots=True)
class Repair:
    """One character to be escaped; `offset` is its place in the text."""

    offset: int
    before: str
    after: str
    shown: str


def repairs_of(text: str) -> list[Repair]:
    """Returns the bare `&` and `<` within the attributes of a text."""
    found: list[Repair] = []
    for start, end in _values(text):
        for match in _BARE.finditer(text, start, end):
            bare = match.group()
            found.append(Repair(match.start(), bare, _ESCAPES[bare], text[start:end]))
            if len(found) > XML_REPAIRS:
                return []
    return found


def repaired(text: str, repairs: list[Repair]) -> str:
    """Returns the text with all repairs made."""
    parts, last = [], 0
    for repair in repairs:
        parts += [text[last : repair.offset], repair.after]
        last = repair.offset + len(repair.before)
    return "".join([*parts, text[last:]])


def offers(text: str, repairs: list[Repair], file: str) -> list[Diagnostic]:
    """Returns a finding for each repair: the change, and its place."""
    return [
        diagnostic(
            "BT0740", _place(text, item.offset, file), before=item.before, after=item.after, value=item.shown
        )
        for item in repairs
    ]


def _place(text: str, offset: int, file: str) -> Place:
    line = text.count("\n", 0, offset) + 1
    return Place(file, line=line, column=offset - text.rfind("\n", 0, offset))


def _values(text: str) -> Iterator[tuple[int, int]]:
    """Yields start and end of each attribute's value, without its quotes."""
    position = text.find("<")
    while position >= 0:
        skipped = _SKIPPED.match(text, position)
        if skipped is not None:
            position = text.find("<", skipped.end())
            continue
        tag = _TAG.match(text, position)
        position = tag.end() if tag is not None else position + 1
        while tag is not None and position < len(text) and text[position] != ">":
            if text[position] in "\"'":
                end = text.find(text[position], position + 1)
                if end < 0:
                    return
                yield position + 1, end
                position = end
            position += 1
        position = text.find("<", position)
