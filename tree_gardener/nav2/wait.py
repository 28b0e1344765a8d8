"""Wait of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import duration
from tree_gardener.ports import Port


class Wait(Nav2Action):
    """Waits, by the clock of the server.

    Rule: Nav2's plugins/action/wait_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/Wait"
    ACTION_NAME = "wait"
    INPUT_PORTS = {
        "wait_duration": Port(float, default=1.0, description="The time, in s."),
        "server_name": Port(str, description="Name of the action; wait if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.time = duration(abs(self.read("wait_duration")))
