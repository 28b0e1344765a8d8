"""BackUp of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action, put
from tree_gardener.nav2.poses import duration
from tree_gardener.ports import Port


class BackUp(Nav2Action):
    """Drives the robot back.

    Rule: Nav2's plugins/action/back_up_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/BackUp"
    ACTION_NAME = "backup"
    INPUT_PORTS = {
        "backup_dist": Port(float, default=0.15, description="The distance, in m."),
        "backup_speed": Port(float, default=0.025, description="The speed, in m/s."),
        "time_allowance": Port(float, default=10.0, description="The longest time for it, in s."),
        "disable_collision_checks": Port(
            bool, default=False, description="Whether the robot may drive into things."
        ),
        "server_name": Port(str, description="Name of the action; backup if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.target.x = float(self.read("backup_dist"))
        goal.speed = float(self.read("backup_speed"))
        goal.time_allowance = duration(self.read("time_allowance"))
        put(goal, disable_collision_checks=self.read("disable_collision_checks", otherwise=False))
