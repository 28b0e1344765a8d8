"""Zero velocities on the command topics of a run."""

from __future__ import annotations

import pytest
import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.context import Context
from rclpy.node import Node
from std_msgs.msg import String

from executor.application.zeros import PERIOD_S, Zeros


@pytest.fixture
def node():
    context = Context()
    rclpy.init(context=context)
    node = Node("zeros", context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def test_each_publisher_of_velocities_sends_zero_ten_times_a_second(node, monkeypatch):
    sent = []
    for kind, topic in ((Twist, "/a"), (TwistStamped, "/b"), (String, "/c")):
        publisher = node.create_publisher(kind, topic, 1)
        monkeypatch.setattr(
            type(publisher), "publish", lambda self, message: sent.append((self.topic_name, message))
        )
    now = [5.0]
    zeros = Zeros(node, lambda: now[0])
    zeros.send()
    zeros.send()
    assert [(topic, type(message)) for topic, message in sent] == [("/a", Twist), ("/b", TwistStamped)]
    assert sent[0][1].linear.x == 0
    now[0] += PERIOD_S
    zeros.send()
    assert len(sent) == 4
