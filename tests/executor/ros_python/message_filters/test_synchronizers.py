"""Messages combined by their stamps, compared with a search of all combinations."""

import itertools
from typing import Any

from hypothesis import given
from hypothesis import strategies as st
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import Imu
from std_msgs.msg import Header, String

MS = 1_000_000


def message(stamp_ms: int) -> Header:
    return type("Message", (), {"header": Header(stamp=Time(nanoseconds=stamp_ms * MS).to_msg())})()


def stamps(messages: Any) -> tuple[int, ...]:
    return tuple(each.header.stamp.sec * 1000 + each.header.stamp.nanosec // MS for each in messages)


def inputs(count: int) -> Any:
    from message_filters import SimpleFilter

    return [SimpleFilter() for _ in range(count)]


def test_exact_stamps_meet_whatever_the_order() -> None:
    from message_filters import TimeSynchronizer

    got: list[Any] = []
    sources = inputs(2)
    TimeSynchronizer(sources, 10).registerCallback(lambda *each: got.append(stamps(each)))
    for which, stamp in ((0, 1), (0, 2), (1, 2), (1, 1), (1, 3)):
        sources[which].signalMessage(message(stamp))
    assert got == [(2, 2), (1, 1)]


def test_only_as_many_wait_as_the_queue_holds() -> None:
    from message_filters import TimeSynchronizer

    got: list[Any] = []
    sources = inputs(2)
    TimeSynchronizer(sources, 2).registerCallback(lambda *each: got.append(stamps(each)))
    for stamp in (1, 2, 3):
        sources[0].signalMessage(message(stamp))
    for stamp in (1, 2, 3):
        sources[1].signalMessage(message(stamp))
    assert got == [(2, 2), (3, 3)]


@given(
    st.lists(st.tuples(st.integers(0, 2), st.integers(0, 400)), max_size=40, unique=True),
    st.integers(1, 60),
)
def test_what_meets_is_near_and_nothing_near_is_left_waiting(sent: Any, slop_ms: int) -> None:
    from message_filters import ApproximateTimeSynchronizer

    got: list[Any] = []
    sources = inputs(3)
    filtered = ApproximateTimeSynchronizer(sources, 100, slop_ms / 1000)
    filtered.registerCallback(lambda *each: got.append(stamps(each)))
    for count, (which, stamp) in enumerate(sent, 1):
        sources[which].signalMessage(message(stamp))
        left = [{s for w, s in sent[:count] if w == i} - {each[i] for each in got} for i in range(3)]
        meeting = [each for each in itertools.product(*left) if max(each) - min(each) < slop_ms]
        assert not meeting, "they could have met"
    for each in got:
        assert max(each) - min(each) < slop_ms
    for of_one in zip(*got, strict=True):
        assert len(set(of_one)) == len(of_one), "each message is put out once"


def test_the_nearest_is_taken() -> None:
    from message_filters import ApproximateTimeSynchronizer

    got: list[Any] = []
    sources = inputs(2)
    ApproximateTimeSynchronizer(sources, 10, 0.1).registerCallback(lambda *each: got.append(stamps(each)))
    for stamp in (20, 55, 90):
        sources[0].signalMessage(message(stamp))
    sources[1].signalMessage(message(60))
    assert got == [(55, 60)]


def test_what_has_no_stamp_is_left_out_unless_it_may_come() -> None:
    from message_filters import ApproximateTimeSynchronizer

    for allowed in (False, True):
        got: list[Any] = []
        sources = inputs(2)
        filtered = ApproximateTimeSynchronizer(sources, 10, 5.0, allow_headerless=allowed)
        filtered.registerCallback(lambda *each, got=got: got.append(each))
        for source in sources:
            source.signalMessage(String(data="x"))
        assert len(got) == allowed


def test_subscribers_feed_a_synchronizer(context: Context) -> None:
    from message_filters import ApproximateTimeSynchronizer, Subscriber

    node = Node("filters", context=context)
    got: list[Any] = []
    first, second = Subscriber(node, Imu, "/imu_a"), Subscriber(node, Imu, "/imu_b", qos_profile=5)
    assert (first.getTopic(), second.topic_name) == ("/imu_a", "/imu_b")
    ApproximateTimeSynchronizer([first, second], 10, 0.05).registerCallback(lambda *each: got.append(each))
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    publishers = [node.create_publisher(Imu, topic, 10) for topic in ("/imu_a", "/imu_b")]
    for publisher, stamp in zip(publishers, (100, 120), strict=True):
        publisher.publish(Imu(header=message(stamp).header))
    for _ in range(100):
        if not got:
            executor.spin_once(timeout_sec=0.2)
    assert stamps(got[0]) == (100, 120)
    executor.shutdown()
    node.destroy_node()
