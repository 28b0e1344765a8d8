"""DockRobot of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import pose_from
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class DockRobot(Nav2Action):
    """Docks the robot.

    Rule: Nav2's opennav_docking_bt/src/dock_robot.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/DockRobot"
    ACTION_NAME = "dock_robot"
    INPUT_PORTS = {
        "use_dock_id": Port(bool, default=True, description="Whether the dock is given by its name."),
        "dock_id": Port(str, description="The name of the dock."),
        "dock_pose": Port(description="The pose of the dock; a text is x;y;yaw in the map."),
        "dock_type": Port(str, description="The type of the dock."),
        "max_staging_time": Port(
            float, default=1000.0, description="The longest time to the staging pose, in s."
        ),
        "navigate_to_staging_pose": Port(
            bool, default=True, description="Whether the robot drives to the staging pose first."
        ),
        "server_name": Port(str, description="Name of the action; dock_robot if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "success": Port(bool, description="Whether it succeeded."),
        "num_retries": Port(int, description="The number of retries."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.use_dock_id = bool(self.read("use_dock_id"))
        if goal.use_dock_id:
            goal.dock_id = str(self.read("dock_id"))
        else:
            goal.dock_pose = pose_from(self.read("dock_pose"))
            goal.dock_type = str(self.read("dock_type"))
            goal.max_staging_time = float(self.read("max_staging_time"))
        goal.navigate_to_staging_pose = bool(self.read("navigate_to_staging_pose"))

    def give_result(self, result: Any) -> None:
        if result is not None:
            give(self, "success", result.success)
            give(self, "num_retries", result.num_retries)

    def on_aborted(self, result: Any) -> Status:
        self.give_result(result)
        return super().on_aborted(result)
