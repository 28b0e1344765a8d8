"""ComputeAndTrackRoute of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.compute_and_track_route import ComputeAndTrackRoute

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_route_is_tracked_and_a_new_goal_replaces_it(ros: Graph) -> None:
    server = Actions(ros, "ComputeAndTrackRoute", ComputeAndTrackRoute.ACTION_NAME, outcome="wait")
    ports = "start_id='3' goal_id='{goal}' last_node_id='{last}' rerouted='{new}'"
    ros.load(f"<ComputeAndTrackRoute {ports}/>", goal=7)
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and len(server.goals) == 1)
    leaf = ros.tree.nodes[0].behaviour
    feedback = server.kind.Feedback(last_node_id=4, rerouted=True)
    assert leaf.on_feedback(feedback) is Status.RUNNING
    assert (ros["last"], ros["new"]) == (4, True)
    ros.tree.blackboard["goal"] = 8
    ros.spin(lambda: ros.tree.tick_exactly_once() is Status.RUNNING and len(server.goals) == 2)
    assert [goal.goal_id for goal in server.goals] == [7, 8]
    ros.tree.halt()
    ros.spin(lambda: server.cancelled > 0)


def test_at_the_end_the_feedback_is_reset(ros: Graph) -> None:
    Actions(ros, "ComputeAndTrackRoute", "compute_and_track_route", outcome="abort", error_code=406)
    ports = "start_id='1' goal_id='2' last_node_id='{last}' error_code_id='{code}'"
    assert ros.run(f"<ComputeAndTrackRoute {ports}/>", last=9) is Status.FAILURE
    assert (ros["last"], ros["code"]) == (0, 406)
