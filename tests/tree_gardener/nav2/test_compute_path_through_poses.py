"""ComputePathThroughPoses of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.compute_path_through_poses import ComputePathThroughPoses

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_path_over_all_goals_is_written(ros: Graph) -> None:
    path = Path(poses=[PoseStamped()])
    server = Actions(ros, "ComputePathThroughPoses", ComputePathThroughPoses.ACTION_NAME, path=path)
    body = (
        "<ComputePathThroughPoses goals='1;2;0|3;4;0' start='5;0;0' path='{path}' last_reached_index='{n}'/>"
    )
    assert ros.run(body) is Status.SUCCESS
    (goal,) = server.goals
    assert [pose.pose.position.y for pose in goal.goals] == [2.0, 4.0]
    assert (goal.use_start, goal.start.pose.position.x) == (True, 5.0)
    assert (len(ros["path"].poses), ros["n"]) == (1, -1)
