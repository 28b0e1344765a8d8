"""RemoveInCollisionGoals of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from nav_msgs.msg import Goals

from tests.tree_gardener.nav2.test_cost_leaf import Costmap, pose
from tree_gardener import Status
from tree_gardener.nav2.remove_in_collision_goals import RemoveInCollisionGoals

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

BODY = (
    "<RemoveInCollisionGoals input_goals='{goals}' output_goals='{left}' input_waypoint_statuses='{given}'"
    " output_waypoint_statuses='{marked}'/>"
)
SHORT = "<RemoveInCollisionGoals input_goals='{goals}' output_goals='{left}'/>"
GOALS = Goals(goals=[pose(1), pose(2), pose(3)])


class Waypoint:
    """As nav2_msgs/WaypointStatus, which Jazzy does not have."""

    PENDING, COMPLETED, SKIPPED = 0, 1, 2

    def __init__(self, *, waypoint_pose: Any, waypoint_status: int = PENDING) -> None:
        self.waypoint_pose = waypoint_pose
        self.waypoint_status = waypoint_status

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        return {"waypoint_pose": "", "waypoint_status": ""}


def run(ros: Graph, body: str, **entries: Any) -> Status:
    ros.nodes = {"RemoveInCollisionGoals": RemoveInCollisionGoals}
    return ros.run(body, **entries)


def test_occupied_goals_are_removed(ros: Graph) -> None:
    Costmap(ros, x1=0, x2=254, x3=253)
    assert run(ros, SHORT, goals=GOALS) is Status.SUCCESS
    assert ros["left"] == Goals(goals=[pose(1), pose(3)])
    assert len(GOALS.goals) == 3


def test_goals_may_be_a_text(ros: Graph) -> None:
    Costmap(ros, x1=254, x2=0)
    assert run(ros, SHORT, goals="1;0;0|2;0;0") is Status.SUCCESS
    assert [each.pose.position.x for each in ros["left"]] == [2.0]


def test_the_statuses_of_removed_goals_become_skipped(ros: Graph) -> None:
    Costmap(ros, x1=0, x2=254, x3=254)
    given = [Waypoint(waypoint_pose=each) for each in GOALS.goals]
    assert run(ros, BODY, goals=GOALS, given=given) is Status.SUCCESS
    assert [each.waypoint_status for each in ros["marked"]] == [0, 2, 2]
    assert run(ros, BODY, goals=GOALS, given=given[:2]) is Status.FAILURE


def test_without_goals_or_an_answer_it_fails_with_all_goals(ros: Graph) -> None:
    Costmap(ros, x1=0)
    assert run(ros, SHORT, goals=Goals()) is Status.FAILURE
    assert ros["left"] == Goals()
    assert run(ros, SHORT, goals=GOALS) is Status.FAILURE
    assert ros["left"] == GOALS
