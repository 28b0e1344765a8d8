"""IsGoalNearby of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, path
from tree_gardener.nav2.is_goal_nearby import IsGoalNearby

PORTS = 'path="{path}" proximity_threshold="1.5"'


def test_the_rest_of_the_path_counts_from_the_pose_nearest_to_the_robot() -> None:
    ros = RosNode()
    trial = Trial(IsGoalNearby, PORTS, ros=ros, path=path(0.0, 1.0, 2.0, 3.0))
    assert trial.tick() == "F"
    ros.place(1.1)
    assert trial.tick() == "F"
    ros.place(1.9)
    assert trial.tick() == "S"
    trial["path"] = path()
    assert trial.tick() == "F"


def test_the_search_continues_from_where_it_was() -> None:
    ros = RosNode()
    points = path(0.0, 1.0, 2.0, 1.0, 0.0)
    ports = f'{PORTS} max_robot_pose_search_dist="1.5"'
    trial = Trial(IsGoalNearby, ports, ros=ros, path=points)
    ros.place(0.0)
    assert trial.tick() == "F"  # not the end, which is at the same place
    for x in (1.0, 2.0):
        ros.place(x)
        assert trial.tick() == "F"
    ros.place(1.0)
    assert trial.tick() == "S"
    assert Trial(IsGoalNearby, PORTS, ros=ros, path=points).tick() == "S"
