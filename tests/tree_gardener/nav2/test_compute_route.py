"""ComputeRoute of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.compute_route import ComputeRoute

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_a_route_between_two_nodes_is_written(ros: Graph) -> None:
    path = Path(poses=[PoseStamped()])
    server = Actions(ros, "ComputeRoute", ComputeRoute.ACTION_NAME, path=path)
    ports = "start_id='3' goal_id='7' path='{path}' route='{route}' planning_time='{took}'"
    assert ros.run(f"<ComputeRoute {ports}/>") is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.start_id, goal.goal_id, goal.use_poses, goal.use_start) == (3, 7, False, False)
    assert (ros["path"], ros["route"].route_cost, ros["took"].sec) == (path, 0.0, 0)


def test_an_error_leaves_an_empty_path(ros: Graph) -> None:
    Actions(ros, "ComputeRoute", "compute_route", outcome="abort", error_code=405)
    body = "<ComputeRoute start_id='1' goal_id='2' path='{path}' error_code_id='{code}'/>"
    assert ros.run(body) is Status.FAILURE
    assert (ros["path"], ros["code"]) == (Path(), 405)


def test_a_halted_node_forgets_its_path(ros: Graph) -> None:
    server = Actions(ros, "ComputeRoute", "compute_route", outcome="wait")
    body = "<ComputeRoute start_id='1' goal_id='2' path='{path}'/>"
    ros.load(body, path=Path(poses=[PoseStamped()]))
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and bool(server.goals))
    ros.tree.halt()
    assert ros["path"] == Path()
    ros.spin(lambda: server.cancelled == 1)
