"""PathHandlerSelector of Nav2."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.path_handler_selector import PathHandlerSelector


def test_the_default_is_written_until_a_name_is_received() -> None:
    ros = RosNode()
    ports = 'default_path_handler="Own" selected_path_handler="{chosen}"'
    trial = Trial(PathHandlerSelector, ports, ros=ros)
    assert trial.tick() == "S"
    assert trial["chosen"] == "Own"
    ros.publish("path_handler_selector", String(data="Other"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "Other"


def test_without_both_it_fails() -> None:
    assert Trial(PathHandlerSelector, 'selected_path_handler="{chosen}"').tick() == "F"
