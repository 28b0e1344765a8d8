"""PlannerSelector of Nav2."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.planner_selector import PlannerSelector


def test_the_default_is_written_until_a_name_is_received() -> None:
    ros = RosNode()
    ports = 'default_planner="Own" selected_planner="{chosen}"'
    trial = Trial(PlannerSelector, ports, ros=ros)
    assert trial.tick() == "S"
    assert trial["chosen"] == "Own"
    ros.publish("planner_selector", String(data="Other"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "Other"


def test_without_both_it_fails() -> None:
    assert Trial(PlannerSelector, 'selected_planner="{chosen}"').tick() == "F"
