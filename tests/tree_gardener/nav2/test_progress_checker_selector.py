"""ProgressCheckerSelector of Nav2."""

from __future__ import annotations

from std_msgs.msg import String

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.progress_checker_selector import ProgressCheckerSelector


def test_the_default_is_written_until_a_name_is_received() -> None:
    ros = RosNode()
    ports = 'default_progress_checker="Own" selected_progress_checker="{chosen}"'
    trial = Trial(ProgressCheckerSelector, ports, ros=ros)
    assert trial.tick() == "S"
    assert trial["chosen"] == "Own"
    ros.publish("progress_checker_selector", String(data="Other"))
    assert trial.tick() == "S"
    assert trial["chosen"] == "Other"


def test_without_both_it_fails() -> None:
    assert Trial(ProgressCheckerSelector, 'selected_progress_checker="{chosen}"').tick() == "F"
