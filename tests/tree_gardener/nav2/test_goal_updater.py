"""GoalUpdater of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, goals, pose, xs
from tree_gardener.nav2.goal_updater import GoalUpdater

PORTS = 'input_goal="{goal}" input_goals="{goals}" output_goal="{new}" output_goals="{news}"'


def test_the_input_is_written_until_a_newer_goal_is_received() -> None:
    ros = RosNode()
    trial = Trial(GoalUpdater, PORTS, children="SRF", ros=ros, goal=pose(1.0, sec=5), goals=goals(1.0, sec=5))
    assert trial.tick() == "S"
    assert trial["new"] == trial["goal"]
    assert trial["news"] == trial["goals"]
    for sec, is_taken in ((4, False), (0, False), (5, True), (6, True)):
        ros.publish("goal_update", pose(2.0, sec=sec))
        ros.publish("goals_update", goals(2.0, 3.0, sec=sec))
        trial.tick()
        assert (trial["new"].pose.position.x == 2.0) is is_taken
        assert (xs(trial["news"]) == [2.0, 3.0]) is is_taken


def test_goals_without_any_are_ignored_and_topics_are_parameters() -> None:
    ros = RosNode(goal_updater_topic="here", goals_updater_topic="there")
    trial = Trial(GoalUpdater, PORTS, children="RRF", ros=ros)
    ros.publish("there", goals(sec=9))
    assert trial.tick() == "R"
    assert xs(trial["news"]) == []
    assert trial["news"].header.stamp.sec == 0
    ros.publish("here", pose(4.0, sec=1))
    assert trial.tick() + trial.tick() == "RF"
    assert trial["new"].pose.position.x == 4.0


def test_without_ros_and_without_outputs_it_ticks_its_child() -> None:
    assert Trial(GoalUpdater, children="S").tick() == "S"
