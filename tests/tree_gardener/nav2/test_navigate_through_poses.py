"""NavigateThroughPoses of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.navigate_through_poses import NavigateThroughPoses

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_all_goals_are_sent_in_order(ros: Graph) -> None:
    server = Actions(ros, "NavigateThroughPoses", NavigateThroughPoses.ACTION_NAME)
    assert ros.run("<NavigateThroughPoses goals='1;2;0|3;4;0' behavior_tree='t'/>") is Status.SUCCESS
    (goal,) = server.goals
    assert [pose.pose.position.x for pose in goal.poses] == [1.0, 3.0]
    assert goal.behavior_tree == "t"
