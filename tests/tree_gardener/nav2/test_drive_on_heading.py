"""DriveOnHeading of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.nav2_servers import Actions
from tree_gardener import Status
from tree_gardener.nav2.drive_on_heading import DriveOnHeading

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_goal_has_the_ports_values(ros: Graph) -> None:
    server = Actions(ros, "DriveOnHeading", DriveOnHeading.ACTION_NAME)
    ports = "dist_to_travel='0.3' speed='0.1' time_allowance='2.5' disable_collision_checks='true'"
    assert (
        ros.run(f"<DriveOnHeading {ports} error_code_id='{{code}}' error_msg='{{why}}'/>") is Status.SUCCESS
    )
    (goal,) = server.goals
    assert goal.target.x == pytest.approx(0.3)
    assert goal.speed == pytest.approx(0.1)
    assert (goal.time_allowance.sec, goal.time_allowance.nanosec) == (2, 500_000_000)
    assert (ros["code"], ros["why"]) == (0, "")


def test_the_defaults_are_those_of_nav2(ros: Graph) -> None:
    server = Actions(ros, "DriveOnHeading", "elsewhere")
    assert ros.run("<DriveOnHeading server_name='elsewhere'/>") is Status.SUCCESS
    assert server.goals[0].time_allowance.sec == 10
