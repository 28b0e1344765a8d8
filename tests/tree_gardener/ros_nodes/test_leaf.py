"""Settings and fields of a ROS node."""

from __future__ import annotations

from typing import Any

import pytest
from geometry_msgs.msg import Pose

from tests.tree_gardener.trees import document
from tree_gardener import ManualClock, PortError, Status, Tree
from tree_gardener.ros_nodes.leaf import NO_ROS, RosLeaf, port_name


class Open(RosLeaf):
    """Accepts any port."""

    def update(self) -> Status:
        return Status.SUCCESS


def leaf(ports: str, **entries: Any) -> Any:
    tree = Tree.from_xml(document(f"<Open {ports}/>"), {"Open": Open}, ManualClock())
    for key, value in entries.items():
        tree.blackboard[key] = value
    tree.setup()
    return tree.nodes[0].behaviour


def test_settings_are_ports_with_defaults() -> None:
    made = leaf("server_timeout='250' latched='true' action_name='{name}'", name="/go")
    assert made.seconds("server_timeout", 1000) == 0.25
    assert made.seconds("wait", 1000) == 1.0
    assert made.flag("latched", default=False)
    assert made.text("action_name", "") == "/go"
    assert made.literal("action_name") is None
    assert made.result("if_missing", Status.FAILURE) is Status.FAILURE


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda made: made.text("name", ""), "was given no value"),
        (lambda made: made.seconds("slow", 1), "no number of milliseconds"),
        (lambda made: made.result("bad", Status.FAILURE), "write SUCCESS, FAILURE or SKIPPED"),
        (lambda made: made.joined(), NO_ROS[:20]),
    ],
)
def test_a_wrong_setting_is_explained(ask: Any, message: str) -> None:
    with pytest.raises(PortError, match=message):
        ask(leaf("slow='long' bad='RUNNING'"))


def test_ports_fill_a_message_the_whole_before_its_parts() -> None:
    whole = Pose()
    whole.position.y = 3.0
    made = leaf(f"{port_name('goal', 'position', 'x')}='1.5' goal='{{whole}}'", whole=whole)
    filled = made.fill(Pose(), "goal")
    assert (filled.position.x, filled.position.y) == (1.5, 3.0)
    assert whole.position.x == 0.0, "the entry of the blackboard is somebody else's too"


def test_ports_receive_fields() -> None:
    made = leaf("result__position__x='{x}'")
    pose = Pose()
    pose.position.x = 2.0
    made.give_fields(pose, "result")
    assert made.tree_gardener_node.board.find("x").value == 2.0
