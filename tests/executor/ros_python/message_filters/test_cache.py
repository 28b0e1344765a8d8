"""A cache of messages."""

import pytest
from rclpy.time import Time

from tests.executor.ros_python.message_filters.test_synchronizers import inputs, message, stamps


def test_a_cache_answers_by_time() -> None:
    from message_filters import Cache

    [source] = inputs(1)
    cache = Cache(source, 3)
    assert (cache.getLast(), cache.getOldestTime()) == (None, None)
    for stamp in (10, 20, 30, 40):
        source.signalMessage(message(stamp))
    time = lambda ms: Time.from_msg(message(ms).header.stamp)  # noqa: E731
    assert stamps(cache.getInterval(time(15), time(30))) == (20, 30)
    assert stamps([cache.getElemBeforeTime(time(35)), cache.getElemAfterTime(time(35))]) == (30, 40)
    assert cache.getElemBeforeTime(time(15)) is None
    assert cache.getElemAfterTime(time(45)) is None
    assert (cache.getOldestTime(), cache.getLastestTime()) == (time(20), time(40))
    assert stamps([cache.getLast()]) == (40,)
    with pytest.raises(ValueError, match="ends before"):
        cache.getInterval(time(30), time(15))
