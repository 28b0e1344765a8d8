"""Brings messages of several sources into the order of their times. Pure; real time is an argument.

Sources send in batches, so one is ahead of the other by up to the time of a batch. A message waits until each
source that is awake has sent something later, or was silent for a while. A source without messages
sends the time alone with each batch.

Two sources of one process, the world and the tree of an exact run, wait for each other however long they are
silent: time waits for both, so that a slow machine must not change their order.
"""

from __future__ import annotations

import heapq
from collections import Counter
from typing import TYPE_CHECKING, Final, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["SILENT_S", "Ordering"]

SILENT_S: Final = 0.7
"""A source that was silent for as long is not waited for; sources send twice in a second."""
MOST_WAITING: Final = 20_000
Item = TypeVar("Item")


class Ordering(Generic[Item]):
    """Messages that wait for those before them."""

    def __init__(self) -> None:
        self._waiting: list[tuple[int, int, Item]] = []
        self._last: dict[int, tuple[int, float]] = {}
        self._process: dict[int, int] = {}
        self._number = 0

    def __len__(self) -> int:
        return len(self._waiting)

    def belongs(self, source: int, process: int) -> None:
        """Records of which process a source is; 0 if nobody knows."""
        if process:
            self._process[source] = process

    def put(self, t_ns: int, item: Item, source: int | None, now_s: float) -> None:
        """Adds a message of a source; None is a source for which nobody waits."""
        self._number += 1
        heapq.heappush(self._waiting, (t_ns, self._number, item))
        if source is not None:
            self._last[source] = t_ns, now_s

    def reached(self, t_ns: int, source: int, now_s: float) -> None:
        """Records that a source sends no more messages before a time."""
        self._last[source] = t_ns, now_s

    def is_behind(self, since_s: float, now_s: float) -> bool:
        """Whether a source that is awake has sent nothing since a moment of real time."""
        return any(heard_s < since_s and now_s - heard_s < SILENT_S for _, heard_s in self._last.values())

    def drop(self, source: int) -> None:
        """Forgets a source, so that no message waits for it."""
        self._last.pop(source, None)
        self._process.pop(source, None)

    def ready(self, now_s: float, *, all_: bool = False) -> Iterator[tuple[int, Item]]:
        """Removes and yields the messages that no earlier one can precede, with their times in ns.

        Of more than `MOST_WAITING` messages the earliest are yielded too; with `all_`, all are.
        """
        processes = Counter(self._process.get(source, -source) for source in self._last)
        waited_for = [
            t_ns
            for source, (t_ns, heard_s) in self._last.items()
            if now_s - heard_s < SILENT_S or processes[self._process.get(source, -source)] > 1
        ]
        until_ns = min(waited_for, default=None)
        while self._waiting and (
            all_ or until_ns is None or self._waiting[0][0] <= until_ns or len(self._waiting) > MOST_WAITING
        ):
            t_ns, _, item = heapq.heappop(self._waiting)
            yield t_ns, item
