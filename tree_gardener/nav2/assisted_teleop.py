"""AssistedTeleop of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import duration
from tree_gardener.ports import Port
from tree_gardener.status import Status


class AssistedTeleop(Nav2Action):
    """People drive the robot; the server keeps it from driving into things.

    Rule: Nav2's plugins/action/assisted_teleop_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/AssistedTeleop"
    ACTION_NAME = "assisted_teleop"
    INPUT_PORTS = {
        "is_recovery": Port(bool, default=False, description="Whether a failure counts."),
        "time_allowance": Port(float, default=10.0, description="The longest time for it, in s."),
        "server_name": Port(str, description="Name of the action; assisted_teleop if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.time_allowance = duration(self.read("time_allowance"))

    def on_aborted(self, result: Any) -> Status:
        super().on_aborted(result)
        return Status.FAILURE if self.read("is_recovery") else Status.SUCCESS
