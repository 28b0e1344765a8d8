"""SmootherSelector of Nav2."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.smoother_selector import SmootherSelector


def test_the_default_is_written_until_a_name_is_received() -> None:
    ros = RosNode()
    ports = 'default_smoother="Own" selected_smoother="{chosen}"'
    trial = Trial(SmootherSelector, ports, ros=ros)
    assert trial.tick() == "S"
    assert trial["chosen"] == "Own"
    ros.publish("smoother_selector", String(data="Other"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "Other"


def test_without_both_it_fails() -> None:
    assert Trial(SmootherSelector, 'selected_smoother="{chosen}"').tick() == "F"
