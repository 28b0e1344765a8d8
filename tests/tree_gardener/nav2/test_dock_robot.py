"""DockRobot of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.dock_robot import DockRobot

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_a_dock_is_given_by_its_name(ros: Graph) -> None:
    server = Actions(ros, "DockRobot", DockRobot.ACTION_NAME, success=True, num_retries=2)
    body = "<DockRobot dock_id='home' success='{ok}' num_retries='{n}' navigate_to_staging_pose='false'/>"
    assert ros.run(body) is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.use_dock_id, goal.dock_id, goal.navigate_to_staging_pose) == (True, "home", False)
    assert (ros["ok"], ros["n"]) == (True, 2)


def test_or_by_its_pose_and_a_failure_tells_the_retries(ros: Graph) -> None:
    result = {"success": False, "num_retries": 3, "error_code": 904}
    server = Actions(ros, "DockRobot", "dock_robot", outcome="abort", **result)
    where = "use_dock_id='false' dock_pose='1;2;0' dock_type='t' max_staging_time='5'"
    body = f"<DockRobot {where} success='{{ok}}' num_retries='{{n}}' error_code_id='{{code}}'/>"
    assert ros.run(body) is Status.FAILURE
    (goal,) = server.goals
    assert (goal.use_dock_id, goal.dock_pose.pose.position.y, goal.dock_type) == (False, 2.0, "t")
    assert goal.max_staging_time == 5.0
    assert (ros["ok"], ros["n"], ros["code"]) == (False, 3, 904)
