"""Topics of Nav2's nodes."""

from __future__ import annotations

import pytest
from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, odometry
from tree_gardener.nav2.topics import Odometer, Topic, message_class, parameter


def test_the_latest_message_is_taken_once() -> None:
    ros = RosNode()
    topic = Topic(ros, "std_msgs", "String")
    topic.follow("/a")
    topic.follow("/a")
    assert len(ros.topics["/a"]) == 1
    ros.publish("/a", String(data="1"))
    ros.publish("/a", String(data="2"))
    assert topic.take().data == "2"
    assert topic.take() is None
    topic.close()
    topic.close()
    assert ros.topics["/a"] == []
    assert message_class("std_msgs", "String") is String


def test_without_ros_nothing_is_received() -> None:
    topic = Topic(None, "not_a_package", "Message")
    topic.follow("/a")
    topic.close()
    assert topic.take() is None
    assert parameter(None, "name", 5) == 5
    assert Odometer(None).speed() == 0.0


def test_speed_is_smoothed_over_the_filter_duration() -> None:
    ros = RosNode(filter_duration=1.0, odom_topic="/wheels")
    odometer = Odometer(ros)
    for time_s, speed in ((1.0, 3.0), (2.0, 1.0), (2.5, 2.0)):
        ros.publish("/wheels", odometry(speed, time_s))
    assert odometer.speed() == pytest.approx(1.5)
    assert odometer.latest.twist.twist.linear.x == 2.0
    odometer.close()
    assert ros.topics["/wheels"] == []
