"""ComputePathToPose of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.compute_path_to_pose import ComputePathToPose

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

PATH = Path(poses=[PoseStamped(), PoseStamped()])


def test_the_path_of_the_server_is_written(ros: Graph) -> None:
    server = Actions(ros, "ComputePathToPose", ComputePathToPose.ACTION_NAME, path=PATH)
    ports = "goal='1;2;0' start='0;1;0' planner_id='p' path='{path}' error_code_id='{code}'"
    assert ros.run(f"<ComputePathToPose {ports}/>") is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.goal.pose.position.x, goal.start.pose.position.y, goal.planner_id) == (1.0, 1.0, "p")
    assert goal.use_start
    assert (len(ros["path"].poses), ros["code"]) == (2, 0)


def test_without_a_start_the_robots_pose_is_used(ros: Graph) -> None:
    server = Actions(ros, "ComputePathToPose", "compute_path_to_pose", path=PATH)
    assert ros.run("<ComputePathToPose goal='1;2;0' path='{path}'/>") is Status.SUCCESS
    assert not server.goals[0].use_start


def test_an_error_leaves_an_empty_path(ros: Graph) -> None:
    Actions(ros, "ComputePathToPose", "compute_path_to_pose", outcome="abort", path=PATH, error_code=208)
    body = "<ComputePathToPose goal='1;2;0' path='{path}' error_code_id='{code}'/>"
    assert ros.run(body, path=PATH) is Status.FAILURE
    assert (len(ros["path"].poses), ros["code"]) == (0, 208)
