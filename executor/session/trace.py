"""Parses the stacks that faulthandler dumps for a process that does not respond."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

__all__ = ["Frame", "action_frame", "own_frame"]

_FRAME: Final = re.compile(r'^  File "(?P<file>[^"]*)", line (?P<line>\d+) in (?P<function>.*)$')
_CURRENT: Final = "Current thread"
_ACTIONS: Final = "actions/"
_OWN: Final = re.compile(
    r"(?:^|/)(?P<file>executor/(?:world|render|ros|application|supervision|universes)/.*)$"
)


@dataclass(frozen=True)
class Frame:
    """A line of Python code on a stack."""

    file: str
    line: int
    function: str


def action_frame(text: str) -> Frame | None:
    """Returns the innermost line of an action, first of the current thread, then of the others.

    None if there is none.
    """
    return next((frame for frame in _frames(text) if frame.file.startswith(_ACTIONS)), None)


def own_frame(text: str) -> Frame | None:
    """Returns the innermost line in this repository, with its path in the repository.

    None if there is none.
    """
    for frame in _frames(text):
        if (match := _OWN.search(frame.file)) is not None:
            return Frame(match["file"], frame.line, frame.function)
    return None


def _frames(text: str) -> list[Frame]:
    """Returns all frames, innermost first; those of the current thread come before those of other threads."""
    threads: list[tuple[bool, list[Frame]]] = []
    for line in text.splitlines():
        if match := _FRAME.match(line):
            if threads:
                threads[-1][1].append(Frame(match["file"], int(match["line"]), match["function"]))
        elif "most recent call first" in line:
            threads.append((line.startswith(_CURRENT), []))
    threads.sort(key=lambda thread: not thread[0])
    return [frame for _, frames in threads for frame in frames]
