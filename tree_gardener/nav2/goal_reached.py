"""GoalReached of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import distance
from tree_gardener.nav2.reading import input_or
from tree_gardener.nav2.topics import parameter
from tree_gardener.ports import Port


class GoalReached(Behaviour):
    """Succeeds if the robot is at the goal: within 0.25 m, or the ROS node's parameter `goal_reached_tol`.

    The frame is that of the goal. It fails while the robot's pose is not known.
    Rule: Nav2's plugins/condition/goal_reached_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "goal": Port(description="The goal."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.tolerance = parameter(kwargs.get("node"), "goal_reached_tol", 0.25)

    def update(self) -> Status:
        goal = input_or(self, "goal", None)
        pose = None if goal is None else self.frames.robot_pose(goal.header.frame_id)
        is_there = pose is not None and distance(goal, pose) <= self.tolerance
        return Status.SUCCESS if is_there else Status.FAILURE
