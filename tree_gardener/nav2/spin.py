"""Spin of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action, put
from tree_gardener.nav2.poses import duration
from tree_gardener.ports import Port


class Spin(Nav2Action):
    """Turns the robot on the spot.

    Rule: Nav2's plugins/action/spin_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/Spin"
    ACTION_NAME = "spin"
    INPUT_PORTS = {
        "spin_dist": Port(float, default=1.57, description="The angle, in rad."),
        "time_allowance": Port(float, default=10.0, description="The longest time for it, in s."),
        "is_recovery": Port(bool, default=True, description="Whether it counts as a recovery."),
        "disable_collision_checks": Port(
            bool, default=False, description="Whether the robot may drive into things."
        ),
        "server_name": Port(str, description="Name of the action; spin if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.target_yaw = float(self.read("spin_dist"))
        goal.time_allowance = duration(self.read("time_allowance"))
        put(goal, disable_collision_checks=self.read("disable_collision_checks", otherwise=False))
