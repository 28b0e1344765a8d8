"""The owner of the next place: the one who waits and holds the fewest, so that no owner takes them all.

It decides by its arguments alone. Robots, language servers and tests with Python are given places by it.
"""

from __future__ import annotations

from collections import defaultdict, deque
from heapq import heapify, heappop, heappush
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterable, Mapping


class Wish(NamedTuple):
    """Something that waits for a place.

    Attributes:
        key: what waits.
        owner: the user who wants it.
        since: the time since which it waits.
        is_exempt: whether it goes first, and the limit of its owner does not hold, as for a demonstration.
    """

    key: Hashable
    owner: Hashable
    since: float
    is_exempt: bool = False


class Order(NamedTuple):
    """The order of those that wait.

    Attributes:
        next: those that get the next places, the first one first.
        held_up: those that wait until another entry of the same owner ends, the oldest first.
    """

    next: list[Wish]
    held_up: list[Wish]


def order(waiting: Iterable[Wish], held: Mapping[Hashable, int], most: int) -> Order:
    """Returns the order in which wishes get the places that become free.

    Each place goes to the oldest wish of the owner who then holds the fewest; a place that was given counts.

    Args:
        waiting: the wishes.
        held: the number of places that each owner holds.
        most: the number of places that one owner may hold; 0 is no limit.
    """
    wishes = sorted(waiting, key=lambda wish: wish.since)
    first = [wish for wish in wishes if wish.is_exempt]
    queues: defaultdict[Hashable, deque[Wish]] = defaultdict(deque)
    for wish in wishes:
        if not wish.is_exempt:
            queues[wish.owner].append(wish)
    # Equal owners at equal times keep the order of their wishes: owners cannot be compared.
    ahead = [
        (held.get(owner, 0), queue[0].since, number, owner)
        for number, (owner, queue) in enumerate(queues.items())
    ]
    heapify(ahead)
    held_up: list[Wish] = []
    while ahead:
        count, _, number, owner = heappop(ahead)
        queue = queues[owner]
        if most and count >= most:
            held_up.extend(queue)
            continue
        first.append(queue.popleft())
        if queue:
            heappush(ahead, (count + 1, queue[0].since, number, owner))
    return Order(first, sorted(held_up, key=lambda wish: wish.since))
