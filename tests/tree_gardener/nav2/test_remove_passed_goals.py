"""RemovePassedGoals of Nav2."""

from __future__ import annotations

from typing import Any

from tests.tree_gardener.nav2_ros import RosNode, Trial, goals, pose, xs
from tree_gardener.nav2.remove_passed_goals import RemovePassedGoals

PORTS = 'radius="0.5" input_goals="{goals}" output_goals="{new}"'
STATUSES = 'input_waypoint_statuses="{given}" output_waypoint_statuses="{marked}"'


class Waypoint:
    """As nav2_msgs/WaypointStatus."""

    PENDING, COMPLETED = 0, 1

    def __init__(self, *, waypoint_pose: Any, waypoint_status: int = PENDING) -> None:
        self.waypoint_pose = waypoint_pose
        self.waypoint_status = waypoint_status

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        return {"waypoint_pose": "", "waypoint_status": ""}


def test_passed_goals_at_the_beginning_are_removed_but_not_the_last() -> None:
    ros = RosNode()
    trial = Trial(RemovePassedGoals, PORTS, ros=ros, goals=goals(0.4, 0.5, 2.0, 0.0))
    assert trial.tick() == "F"
    ros.place(0.0)
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [2.0, 0.0]
    trial["goals"] = goals(0.1, 0.2)
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [0.2]


def test_statuses_of_removed_goals_become_completed() -> None:
    ros = RosNode()
    given = [Waypoint(waypoint_pose=pose(x)) for x in (0.0, 5.0)]
    trial = Trial(RemovePassedGoals, f"{PORTS} {STATUSES}", ros=ros, goals=goals(0.0, 5.0), given=given)
    ros.place(0.0)
    assert trial.tick() == "S"
    assert [status.waypoint_status for status in trial["marked"]] == [1, 0]
    assert given[0].waypoint_status == 0
    trial["given"] = given[1:]
    assert trial.tick() == "F"


def test_no_goals_succeed() -> None:
    assert Trial(RemovePassedGoals, PORTS).tick() == "S"
    trial = Trial(RemovePassedGoals, PORTS, goals=goals())
    assert trial.tick() == "S"
    assert xs(trial["new"]) == []
