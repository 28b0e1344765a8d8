"""Faults of topics."""

import pytest

from executor.ros.topic_faults import TopicFaults


def test_silence_and_what_comes_after_it():
    faults = TopicFaults()
    assert faults.take("/scan", 1, 0.0) == [1]
    faults.silence("/scan", on=True)
    assert faults.take("/scan", 2, 0.1) == []
    assert faults.take("/odom", 2, 0.1) == [2]
    faults.silence("/scan", on=True)
    faults.silence("/scan", on=False)
    assert faults.take("/scan", 3, 0.2) == []  # the other one lasts
    faults.silence("/scan", on=False)
    assert faults.take("/scan", 4, 0.3) == [4]


def test_a_frozen_topic_repeats_its_last_message():
    faults = TopicFaults()
    faults.take("/scan", 1, 0.0)
    faults.freeze("/scan", on=True)
    assert [faults.take("/scan", n, 0.1 * n) for n in (2, 3)] == [[1], [1]]
    faults.freeze("/scan", on=False)
    assert faults.take("/scan", 4, 0.4) == [4]


def test_delayed_messages_come_when_they_are_due_and_in_order():
    faults = TopicFaults()
    faults.delay("/scan", 0.5, on=True)
    assert faults.take("/scan", 1, 0.0) == []
    assert faults.take("/scan", 2, 0.1) == []
    faults.delay("/scan", 0.5, on=False)
    assert faults.take("/scan", 3, 0.2) == [3]
    assert faults.due(0.4, {"/scan"}) == []
    assert faults.due(0.6, {"/odom"}) == []
    assert faults.due(0.6, {"/scan"}) == [("/scan", 1), ("/scan", 2)]
    assert faults.due(9, {"/scan"}) == []


def test_a_share_is_dropped():
    faults = TopicFaults()
    draw = iter([0.1, 0.5, 0.29, 0.3]).__next__
    faults.drop("/scan", 0.3, draw, on=True)
    assert [faults.take("/scan", n, n) for n in range(4)] == [[], [1], [], [3]]
    faults.drop("/scan", 0.3, draw, on=False)
    assert faults.take("/scan", 4, 4) == [4]
    with pytest.raises(ValueError):  # noqa: PT011 - it is not on
        faults.drop("/scan", 0.3, draw, on=False)
