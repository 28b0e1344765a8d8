"""TruncatePathLocal of Nav2."""

from __future__ import annotations

from geometry_msgs.msg import Quaternion

from tests.tree_gardener.nav2_ros import RosNode, Trial, path, pose, xs
from tree_gardener.nav2.truncate_path_local import TruncatePathLocal

PORTS = 'input_path="{path}" output_path="{new}" distance_forward="1.5" distance_backward="1.0"'
POINTS = (0.0, 1.0, 2.0, 3.0, 4.0, 5.0)


def test_the_part_around_the_robot_is_written() -> None:
    ros = RosNode()
    trial = Trial(TruncatePathLocal, PORTS, ros=ros, path=path(*POINTS))
    assert trial.tick() == "F"
    ros.place(3.1)
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [2.0, 3.0, 4.0]
    trial["path"] = path()
    assert trial.tick() == "S"
    assert xs(trial["new"]) == []


def test_a_pose_takes_the_place_of_the_robot_and_minus_one_is_to_the_end() -> None:
    ports = PORTS.replace('"1.5"', '"-1"') + ' pose="{at}"'
    trial = Trial(TruncatePathLocal, ports, path=path(*POINTS), at=pose(2.2))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert Trial(TruncatePathLocal, ports, at=pose(2.2)).tick() == "F"


def test_a_bounded_search_continues_from_where_it_was() -> None:
    ports = f'{PORTS} pose="{{at}}" max_robot_pose_search_dist="1.5"'
    trial = Trial(TruncatePathLocal, ports, path=path(0.0, 1.0, 2.0, 1.0, 0.0), at=pose(0.0))
    for x, expected in ((0.0, [0.0, 1.0]), (1.0, [0.0, 1.0, 2.0]), (2.0, [1.0, 2.0, 1.0])):
        trial["at"] = pose(x)
        assert trial.tick() == "S"
        assert xs(trial["new"]) == expected


def test_turns_count_by_their_weight() -> None:
    points = path(0.0, 1.0)
    points.poses[0].pose.orientation = Quaternion(x=0.0, y=0.0, z=1.0, w=0.0)
    ports = f'{PORTS.replace("1.0", "0.0")} pose="{{at}}" angular_distance_weight="1.0"'
    trial = Trial(TruncatePathLocal, ports, path=points, at=pose(0.1))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [1.0]
