"""A fair queue for workers: the next item is of the owner with the fewest in progress; each has a limit."""

from __future__ import annotations

from collections import Counter, OrderedDict, deque
from typing import Generic, TypeVar

Item = TypeVar("Item")


class QueueFullError(Exception):
    """The queue is full, for all owners or for this one."""


class FairQueue(Generic[Item]):
    """Queues of all owners; those with equally many in progress take turns.

    It is not thread-safe: the caller holds a lock.

    Args:
        room: the number of items of all owners that may wait. One owner may have half of them, and so cannot
            fill the queue alone.
        per_owner: the number of items of one owner that may be in progress at the same time.
    """

    def __init__(self, *, room: int, per_owner: int) -> None:
        self._room, self._per_owner = room, per_owner
        self._own_room = max(1, room // 2)
        self._waiting: OrderedDict[str, deque[Item]] = OrderedDict()
        self._at_work: Counter[str] = Counter()

    def __len__(self) -> int:
        """Returns the number of items that wait."""
        return sum(map(len, self._waiting.values()))

    def put(self, owner: str, item: Item) -> None:
        """Adds an item to the queue.

        Raises:
            QueueFullError: the queue is full, or this owner has their part of it.
        """
        own = self._waiting.get(owner, ())
        if len(self) >= self._room or len(own) >= self._own_room:
            raise QueueFullError
        self._waiting.setdefault(owner, deque()).append(item)

    def take(self) -> tuple[str, Item] | None:
        """Removes the next item, counts it as in progress, and returns it with its owner.

        Returns None if the queue is empty, or if every waiting owner is at its limit.
        """
        owner = min(self._waiting, key=self._at_work.__getitem__, default=None)
        if owner is None or self._at_work[owner] >= self._per_owner:
            return None
        items = self._waiting[owner]
        item = items.popleft()
        self._waiting.move_to_end(owner)
        if not items:
            del self._waiting[owner]
        self._at_work[owner] += 1
        return owner, item

    def done(self, owner: str) -> None:
        """Notes that one item of this owner is no longer in progress."""
        self._at_work[owner] -= 1
        if not self._at_work[owner]:
            del self._at_work[owner]
