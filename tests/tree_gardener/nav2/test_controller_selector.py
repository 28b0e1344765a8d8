"""ControllerSelector of Nav2."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.controller_selector import ControllerSelector


def test_the_default_is_written_until_a_name_is_received() -> None:
    ros = RosNode()
    ports = 'default_controller="Own" selected_controller="{chosen}"'
    trial = Trial(ControllerSelector, ports, ros=ros)
    assert trial.tick() == "S"
    assert trial["chosen"] == "Own"
    ros.publish("controller_selector", String(data="Other"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "Other"


def test_without_both_it_fails() -> None:
    assert Trial(ControllerSelector, 'selected_controller="{chosen}"').tick() == "F"
