"""An action server whose goals are ended by hand."""

from __future__ import annotations

import os
from typing import Any

import pytest
from nav2_msgs.action import Wait
from rclpy.action import ActionClient

from executor.navigation.server import StepServer
from tests.tree_gardener.ros_graph import graph

os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
EXECUTING, SUCCEEDED, CANCELED, ABORTED = 2, 4, 5, 6


@pytest.mark.parametrize(
    ("reached", "cancels", "status"),
    [(True, False, SUCCEEDED), (False, False, ABORTED), (True, True, CANCELED)],
)
def test_a_goal_is_under_way_until_it_is_ended(reached: bool, cancels: bool, status: int) -> None:
    handles: list[Any] = []
    with graph() as ros:
        server = StepServer(ros.other, Wait, "wait", lambda _server, handle: handles.append(handle))
        client = ActionClient(ros.tree_node, Wait, "wait")
        ros.spin(client.server_is_ready)
        sending = client.send_goal_async(Wait.Goal())
        ros.spin(sending.done)
        answer = sending.result().get_result_async()
        if cancels:
            sending.result().cancel_goal_async()
            ros.spin(lambda: handles[0].is_cancel_requested)
        assert not answer.done()
        server.end(handles[0], Wait.Result(error_code=7), reached=reached)
        ros.spin(answer.done)
        assert (answer.result().status, answer.result().result.error_code) == (status, 7)
        client.destroy()
