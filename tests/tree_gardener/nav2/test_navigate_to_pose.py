"""NavigateToPose of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status, TickError
from tree_gardener.nav2.navigate_to_pose import NavigateToPose

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_a_goal_is_a_text_or_a_message(ros: Graph) -> None:
    server = Actions(ros, "NavigateToPose", NavigateToPose.ACTION_NAME)
    assert ros.run("<NavigateToPose goal='1;2;0' behavior_tree='own.xml'/>") is Status.SUCCESS
    pose = server.goals[0].pose
    assert ros.run("<NavigateToPose goal='{there}'/>", there=pose) is Status.SUCCESS
    first, second = server.goals
    assert first.pose == second.pose
    assert (pose.header.frame_id, pose.pose.position.x, pose.pose.position.y) == ("map", 1.0, 2.0)
    assert (first.behavior_tree, second.behavior_tree) == ("own.xml", "")


def test_an_aborted_goal_fails_with_the_servers_reason(ros: Graph) -> None:
    more = {"outcome": "abort", "error_code": 9, "error_msg": "no way"}
    Actions(ros, "NavigateToPose", "navigate_to_pose", **more)  # type: ignore[arg-type]
    body = "<NavigateToPose goal='1;2;0' error_code_id='{code}' error_msg='{why}'/>"
    assert ros.run(body) is Status.FAILURE
    assert (ros["code"], ros["why"]) == (9, "no way")


def test_a_text_that_is_no_pose_is_an_error_of_the_node(ros: Graph) -> None:
    Actions(ros, "NavigateToPose", "navigate_to_pose")
    with pytest.raises(TickError, match="'somewhere' is no pose"):
        ros.run("<NavigateToPose goal='somewhere'/>")
