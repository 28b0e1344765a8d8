"""The order of messages of several sources."""

from __future__ import annotations

import random

from executor.recorder import ordering
from executor.recorder.ordering import SILENT_S, Ordering


def test_a_message_waits_until_the_other_source_told_something_later():
    order = Ordering[str]()
    order.put(10, "a", 1, 0.0)
    order.put(5, "b", 2, 0.0)
    order.put(20, "c", 1, 0.0)
    assert list(order.ready(0.0)) == [(5, "b")]
    order.put(15, "d", 2, 0.1)
    assert list(order.ready(0.1)) == [(10, "a"), (15, "d")]
    assert len(order) == 1


def test_a_source_that_is_silent_or_gone_is_not_waited_for():
    order = Ordering[str]()
    order.put(5, "b", 2, 0.0)
    order.put(20, "a", 1, 0.2)
    assert list(order.ready(0.2)) == [(5, "b")]
    assert list(order.ready(SILENT_S)) == [(20, "a")]
    order.put(21, "c", 2, 1.0)
    order.put(30, "d", 1, 1.0)
    assert list(order.ready(1.0)) == [(21, "c")]
    order.drop(2)
    assert list(order.ready(1.0)) == [(30, "d")]


def test_two_sources_of_one_process_wait_for_each_other_however_long_they_are_silent():
    order = Ordering[str]()
    order.belongs(1, 77)
    order.belongs(2, 77)
    order.put(5, "tick 1", 2, 0.0)
    order.put(20, "scan", 1, 0.0)
    assert list(order.ready(0.0)) == [(5, "tick 1")]
    assert list(order.ready(60.0)) == []
    order.put(10, "tick 2", 2, 61.0)
    order.reached(20, 2, 61.0)
    assert list(order.ready(61.0)) == [(10, "tick 2"), (20, "scan")]
    order.put(30, "last scan", 1, 62.0)
    order.drop(2)  # the process ends
    assert list(order.ready(62.0)) == [(30, "last scan")]


def test_a_source_whose_process_nobody_knows_waits_for_no_other():
    order = Ordering[str]()
    order.belongs(1, 0)
    order.belongs(2, 0)
    order.put(5, "b", 2, 0.0)
    order.put(20, "a", 1, 0.2)
    assert list(order.ready(SILENT_S)) == [(5, "b"), (20, "a")]


def test_a_source_without_anything_to_tell_says_how_far_it_has_come():
    order = Ordering[str]()
    order.put(5, "b", 2, 0.0)
    order.put(20, "a", 1, 0.0)
    assert list(order.ready(0.0)) == [(5, "b")]
    order.reached(19, 2, 0.1)
    assert list(order.ready(0.1)) == []
    order.reached(20, 2, 0.2)
    assert list(order.ready(0.2)) == [(20, "a")]


def test_a_source_is_behind_until_it_tells_something_or_was_silent_for_long():
    order = Ordering[str]()
    assert not order.is_behind(1.0, 1.0)
    order.reached(5, 1, 1.1)
    order.reached(5, 2, 0.6)
    assert order.is_behind(1.0, 1.1)
    assert not order.is_behind(1.0, 0.7 + SILENT_S)
    order.reached(6, 2, 1.15)
    assert not order.is_behind(1.0, 1.2)


def test_at_the_end_all_are_taken_and_many_do_not_wait(monkeypatch):
    monkeypatch.setattr(ordering, "MOST_WAITING", 10)
    order = Ordering[int]()
    order.put(0, -1, 2, 0.0)
    for number in range(30):
        order.put(number + 1, number, 1, 0.0)
    assert [item for _, item in order.ready(0.0)][:3] == [-1, 0, 1]
    assert len(order) == 10
    assert [item for _, item in order.ready(0.0, all_=True)] == list(range(20, 30))


def test_messages_of_one_time_keep_their_order_and_batches_of_two_sources_are_merged():
    chance = random.Random(1)  # noqa: S311 - reproducible
    order = Ordering[tuple[int, int]]()
    found, told, now_s = [], [0, 0], 0.0
    for _ in range(200):
        source = chance.randrange(2)
        for _ in range(chance.randrange(20)):
            order.put(told[source] // 3, (source, told[source]), source, now_s)
            told[source] += 1
        found += [item for _, item in order.ready(now_s)]
        now_s += SILENT_S / 50
    found += [item for _, item in order.ready(now_s, all_=True)]
    for source in (0, 1):
        assert [number for each, number in found if each == source] == list(range(told[source]))
