"""RemovePassedGoals of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import copied, distance
from tree_gardener.nav2.poses import poses_from, regrouped
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class RemovePassedGoals(Behaviour):
    """Removes the first goals while the robot is within `radius` of them; the last goal always stays.

    If `input_waypoint_statuses` is given, the first pending status of each removed goal becomes completed; if
    there is none, the node fails. It fails while the robot's pose is not known, and succeeds if there are no
    goals. Rule: Nav2's plugins/action/remove_passed_goals_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "radius": Port(float, default=0.5, description="The distance that counts as passed, in m."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
        "input_goals": Port(description="The goals."),
        "input_waypoint_statuses": Port(description="The status of each waypoint."),
    }
    OUTPUT_PORTS = {
        "output_goals": Port(description="The goals that are left."),
        "output_waypoint_statuses": Port(description="The statuses, with the passed waypoints marked."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))

    def update(self) -> Status:
        goals = input_or(self, "input_goals", None)
        left = [] if goals is None else poses_from(goals)
        if not left:
            if goals is not None:
                give(self, "output_goals", goals)
            return Status.SUCCESS
        pose = self.frames.robot_pose(left[0].header.frame_id)
        if pose is None:
            return Status.FAILURE
        given = input_or(self, "input_waypoint_statuses", None)
        statuses = list(given or ())
        while len(left) > 1 and distance(left[0], pose) <= input_or(self, "radius", 0.5):
            if given is not None and not complete(statuses, left[0]):
                return Status.FAILURE
            del left[0]
        give(self, "output_goals", regrouped(goals, left))
        give(self, "output_waypoint_statuses", statuses)
        return Status.SUCCESS


def complete(statuses: list[Any], goal: Any, outcome: str = "COMPLETED") -> bool:
    """Marks the first pending waypoint at a goal with an outcome; returns whether there is one."""
    for index, status in enumerate(statuses):
        if status.waypoint_pose == goal and status.waypoint_status == status.PENDING:
            statuses[index] = copied(status, waypoint_status=getattr(status, outcome))
            return True
    return False
