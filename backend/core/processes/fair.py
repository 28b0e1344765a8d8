"""The queue of items that wait for a worker: owners take turns, and none has more than its share at work."""

from __future__ import annotations

from collections import Counter, OrderedDict, deque
from typing import Generic, TypeVar

Item = TypeVar("Item")


class QueueFullError(Exception):
    """Nothing more may wait."""


class FairQueue(Generic[Item]):
    """A queue for each owner, served in turn. The caller sees to it that one thread at a time uses it.

    Args:
        room: how many items may wait, of all owners together; of one owner half as many, so that one owner's
            many requests cannot fill it.
        per_owner: how many items of one owner may be at work at a time.
    """

    def __init__(self, *, room: int, per_owner: int) -> None:
        self._room, self._per_owner = room, per_owner
        self._waiting: OrderedDict[str, deque[Item]] = OrderedDict()
        self._at_work: Counter[str] = Counter()

    def __len__(self) -> int:
        """Returns the number of items that wait."""
        return sum(map(len, self._waiting.values()))

    def put(self, owner: str, item: Item) -> None:
        """Adds an item to the queue.

        Raises:
            QueueFullError: there is no room, or none for this owner.
        """
        own = self._waiting.get(owner, ())
        if len(self) >= self._room or len(own) >= max(1, self._room // 2):
            raise QueueFullError
        self._waiting.setdefault(owner, deque()).append(item)

    def take(self) -> tuple[str, Item] | None:
        """The next item with its owner, now at work; None where every owner that waits has its share."""
        for owner in self._waiting:
            if self._at_work[owner] < self._per_owner:
                break
        else:
            return None
        items = self._waiting[owner]
        item = items.popleft()
        self._waiting.move_to_end(owner)
        if not items:
            del self._waiting[owner]
        self._at_work[owner] += 1
        return owner, item

    def done(self, owner: str) -> None:
        """One item of this owner is no longer at work."""
        self._at_work[owner] -= 1
        if not self._at_work[owner]:
            del self._at_work[owner]
