"""UndockRobot of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.undock_robot import UndockRobot

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_type_and_time_are_sent(ros: Graph) -> None:
    server = Actions(ros, "UndockRobot", UndockRobot.ACTION_NAME, success=True)
    assert ros.run("<UndockRobot dock_type='t' max_undocking_time='9' success='{ok}'/>") is Status.SUCCESS
    (goal,) = server.goals
    assert (goal.dock_type, goal.max_undocking_time, ros["ok"]) == ("t", 9.0, True)


def test_a_failure_is_written(ros: Graph) -> None:
    Actions(ros, "UndockRobot", "undock_robot", outcome="abort", success=False, error_code=905)
    assert ros.run("<UndockRobot success='{ok}' error_code_id='{code}'/>") is Status.FAILURE
    assert (ros["ok"], ros["code"]) == (False, 905)
