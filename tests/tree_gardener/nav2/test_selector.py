"""The rule that all of Nav2's selectors share."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.planner_selector import PlannerSelector
from tree_gardener.nav2.selector import Selector


def test_a_default_that_was_used_stays_and_a_new_topic_is_followed() -> None:
    assert issubclass(PlannerSelector, Selector)
    ros = RosNode()
    ports = 'topic_name="{topic}" default_planner="{own}" selected_planner="{chosen}"'
    trial = Trial(PlannerSelector, ports, ros=ros, topic="one", own="A")
    assert trial.tick() == "S"
    trial["own"], trial["topic"] = "B", "two"
    assert trial.tick() == "S"
    assert trial["chosen"] == "A"
    ros.publish("two", String(data="C"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "C"
    trial.tree.shutdown()
    assert ros.topics == {"one": [], "two": []}
