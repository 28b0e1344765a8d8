"""UndockRobot of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class UndockRobot(Nav2Action):
    """Undocks the robot.

    Rule: Nav2's opennav_docking_bt/src/undock_robot.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/UndockRobot"
    ACTION_NAME = "undock_robot"
    INPUT_PORTS = {
        "dock_type": Port(str, description="The type of the dock."),
        "max_undocking_time": Port(float, default=30.0, description="The longest time for it, in s."),
        "server_name": Port(str, description="Name of the action; undock_robot if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "success": Port(bool, description="Whether it succeeded."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        if self.is_given("dock_type"):
            goal.dock_type = str(self.read("dock_type"))
        goal.max_undocking_time = float(self.read("max_undocking_time"))

    def give_result(self, result: Any) -> None:
        if result is not None:
            give(self, "success", result.success)

    def on_aborted(self, result: Any) -> Status:
        self.give_result(result)
        return super().on_aborted(result)
