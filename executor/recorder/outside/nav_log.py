"""Reads messages `nav2_msgs/BehaviorTreeLog` and `rcl_interfaces/Log` by our definitions, not the file's.

Nav2 added the number of the node in a later version. Which form a message has is seen from its bytes: only
the right one has statuses in it and ends where the message ends.
"""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

from executor.recorder.cdr import CdrError
from executor.recorder.outside.steps import STATUS_WORDS

__all__ = ["NodeChange", "changes_of", "line_of"]

MOST_CHANGES: Final = 1_000_000
_PADDING: Final = 3
_LEVELS: Final = {10: "debug", 20: "info", 30: "warning", 40: "error", 50: "error"}


class NodeChange(NamedTuple):
    """A node that changed; its number is 0 where the log has none."""

    name: str
    number: int
    status: int


def changes_of(data: bytes) -> list[NodeChange]:
    """Returns the changes in a `BehaviorTreeLog`.

    Raises:
        CdrError: it is none.
    """
    problem = CdrError("it is no BehaviorTreeLog")
    for has_number in (True, False):
        try:
            return _changes(data, has_number=has_number)
        except CdrError as error:
            problem = error
    raise problem


def line_of(data: bytes) -> tuple[str, str]:
    """Returns level and text of a `Log` of ROS.

    Raises:
        CdrError: it is none.
    """
    reader = _Reader(data)
    reader.skip(8, 4)
    level = reader.number("B")
    name, text = reader.text(), reader.text()
    return _LEVELS.get(level, "info"), f"{name}: {text}"


def _changes(data: bytes, *, has_number: bool) -> list[NodeChange]:
    reader = _Reader(data)
    reader.skip(8, 4)
    count = reader.number("I")
    if count > min(MOST_CHANGES, len(data)):
        raise CdrError(f"{count} changes in a message of {len(data)} bytes")
    found = []
    for _ in range(count):
        reader.skip(8, 4)
        name = reader.text()
        number = reader.number("H") if has_number else 0
        words = reader.text(), reader.text()
        if not all(word in STATUS_WORDS for word in words):
            raise CdrError("a status is none")
        found.append(NodeChange(name, number, STATUS_WORDS.index(words[1])))
    if reader.left > _PADDING:
        raise CdrError("the message is longer than its changes")
    return found


class _Reader:
    def __init__(self, data: bytes) -> None:
        if data[:1] != b"\0" or data[1:2] not in {b"\0", b"\1"}:
            raise CdrError("it does not begin as CDR")
        self._order = "<" if data[1] else ">"
        self._data = data[4:]
        self._at = 0

    @property
    def left(self) -> int:
        return len(self._data) - self._at

    def skip(self, count: int, align: int) -> None:
        self._at += -self._at % align + count
        if self.left < 0:
            raise CdrError("the message ends too early")

    def number(self, code: str) -> int:
        size = struct.calcsize(f"<{code}")
        self.skip(size, size)
        (value,) = struct.unpack_from(f"{self._order}{code}", self._data, self._at - size)
        return int(value)

    def text(self) -> str:
        length = self.number("I")
        if length > self.left:
            raise CdrError(f"a text of {length} bytes where {self.left} are left")
        self.skip(length, 1)
        return self._data[self._at - length : self._at].rstrip(b"\0").decode("utf-8", "replace")
