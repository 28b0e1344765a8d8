"""Received messages as a condition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from sensor_msgs.msg import BatteryState

from tree_gardener import Status, TickError
from tree_gardener.ros_nodes.subscribe import MODES

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
SUBSCRIBE = "<RosSubscribe topic_name='battery' topic_type='sensor_msgs/msg/BatteryState' "


class Battery:
    """Publishes charges, and waits until the tree's node has received them."""

    def __init__(self, ros: Graph) -> None:
        self.ros = ros
        self.publisher = ros.other.create_publisher(BatteryState, "battery", 10)

    def send(self, percentage: float) -> None:
        behaviour: Any = self.ros.tree.nodes[0].behaviour
        self.ros.spin(lambda: self.publisher.get_subscription_count() == 1)
        before = behaviour._message
        self.publisher.publish(BatteryState(percentage=percentage))
        self.ros.spin(lambda: behaviour._message is not before)


def test_latest_keeps_a_message(ros: Graph) -> None:
    battery = Battery(ros)
    tree = ros.load(f"{SUBSCRIBE} message__percentage='{{charge}}'/>")
    assert tree.tick_exactly_once() is F
    battery.send(0.5)
    assert [tree.tick_exactly_once(), tree.tick_exactly_once()] == [S, S]
    assert ros["charge"] == 0.5


def test_new_counts_a_message_once(ros: Graph) -> None:
    battery = Battery(ros)
    tree = ros.load(f"{SUBSCRIBE} mode='new'/>")
    battery.send(0.5)
    assert [tree.tick_exactly_once(), tree.tick_exactly_once()] == [S, F]
    battery.send(0.25)
    assert tree.tick_exactly_once() is S


def test_wait_is_running_until_a_message_comes_that_counts(ros: Graph) -> None:
    battery = Battery(ros)
    tree = ros.load(
        f"{SUBSCRIBE} mode='wait' condition='percentage &lt; limit' message__percentage='{{c}}'/>"
    )
    tree.blackboard["limit"] = 0.2
    battery.send(0.1)  # from before: it does not count
    assert tree.tick_exactly_once() is R
    battery.send(0.75)
    assert tree.tick_exactly_once() is R
    battery.send(0.125)
    assert tree.tick_exactly_once() is S
    assert ros["c"] == 0.125


def test_waiting_ends_after_the_timeout(ros: Graph) -> None:
    assert "wait" in MODES
    tree = ros.load(f"{SUBSCRIBE} mode='wait' timeout='500'/>")
    assert tree.tick_exactly_once() is R
    ros.clock.advance(0.5)
    assert tree.tick_exactly_once() is F


@pytest.mark.parametrize(
    ("ports", "message"),
    [
        ("message__percentag='{p}'", "did you mean percentage"),
        ("condition='percentage &lt;'", "port 'condition'"),
        ("condition='header.frame_id == 1'", "write a field of a field with __"),
        ("mode='often'", "is not one of latest, new, wait"),
    ],
)
def test_mistakes_are_explained(ros: Graph, ports: str, message: str) -> None:
    with pytest.raises(TickError, match=message):
        ros.run(f"{SUBSCRIBE} {ports}/>")


def test_a_condition_on_no_field_names_the_fields(ros: Graph) -> None:
    battery = Battery(ros)
    ros.load(f"{SUBSCRIBE} condition='charged == 1'/>")
    battery.send(0.5)
    with pytest.raises(TickError, match=r"the message's fields: header, voltage"):
        ros.tree.tick_exactly_once()
