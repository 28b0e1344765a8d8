"""The order in which owners work, and the limits that make them wait."""

from __future__ import annotations

from collections import Counter
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from backend.core.processes.fair import FairQueue, QueueFullError


def test_owners_take_turns():
    queue: FairQueue[Any] = FairQueue(room=10, per_owner=5)
    for item in ("a1", "a2", "a3"):
        queue.put("a", item)
    queue.put("b", "b1")
    assert [queue.take()[1] for _ in range(4)] == ["a1", "b1", "a2", "a3"]


def test_the_owner_with_the_fewest_at_work_is_next():
    queue: FairQueue[Any] = FairQueue(room=10, per_owner=5)
    for item in ("a1", "a2", "b1"):
        queue.put(item[0], item)
    assert [queue.take()[1] for _ in range(2)] == ["a1", "b1"]
    queue.put("b", "b2")
    queue.put("c", "c1")
    queue.done("b")
    # a has one at work, b and c none; b waits longer than c.
    assert [queue.take()[1] for _ in range(3)] == ["b2", "c1", "a2"]


def test_one_owner_has_no_more_than_its_share_at_work():
    queue: FairQueue[Any] = FairQueue(room=10, per_owner=2)
    for n in range(4):
        queue.put("a", n)
    assert [queue.take(), queue.take(), queue.take()] == [("a", 0), ("a", 1), None]
    queue.put("b", "b0")
    assert queue.take() == ("b", "b0")
    queue.done("a")
    assert queue.take() == ("a", 2)
    assert queue.take() is None


def test_what_has_no_room_is_refused():
    queue: FairQueue[Any] = FairQueue(room=2, per_owner=1)
    queue.put("a", 1)
    queue.put("b", 2)
    with pytest.raises(QueueFullError):
        queue.put("c", 3)
    queue.take()
    queue.put("c", 3)
    assert len(queue) == 2


def test_one_owner_fills_half_of_the_room_at_most():
    queue: FairQueue[Any] = FairQueue(room=4, per_owner=1)
    queue.put("a", 1)
    queue.put("a", 2)
    with pytest.raises(QueueFullError):
        queue.put("a", 3)
    queue.put("b", 1)
    queue.put("c", 1)
    with pytest.raises(QueueFullError):
        queue.put("d", 1)


@given(st.lists(st.one_of(st.sampled_from("abc"), st.just("take"), st.just("done")), max_size=60))
def test_everything_is_worked_on_once_and_in_its_owners_order(events):
    queue: FairQueue[Any] = FairQueue(room=1000, per_owner=2)
    put: list[Any] = []
    taken: list[Any] = []
    at_work: Counter[Any] = Counter()
    for n, event in enumerate(events):
        if event == "take":
            found = queue.take()
            if found is not None:
                taken.append(found)
                at_work[found[0]] += 1
                assert at_work[found[0]] <= 2
            else:
                waiting = [owner for owner, item in put if (owner, item) not in taken]
                assert all(at_work[owner] == 2 for owner in waiting)
        elif event == "done":
            for owner in [owner for owner in at_work if at_work[owner]][:1]:
                queue.done(owner)
                at_work[owner] -= 1
        else:
            queue.put(event, n)
            put.append((event, n))
    assert len(queue) == len(put) - len(taken)
    for owner in "abc":
        mine = [item for who, item in put if who == owner]
        assert [item for who, item in taken if who == owner] == mine[
            : len([t for t in taken if t[0] == owner])
        ]
