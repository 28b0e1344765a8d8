"""RemoveInCollisionGoals of Nav2."""

from typing import Any

from tree_gardener.nav2.cost_leaf import Nav2Costs
from tree_gardener.nav2.poses import poses_from, regrouped
from tree_gardener.nav2.reading import give
from tree_gardener.nav2.remove_passed_goals import complete
from tree_gardener.ports import Port
from tree_gardener.status import Status


class RemoveInCollisionGoals(Nav2Costs):
    """Removes the goals that are occupied.

    If `input_waypoint_statuses` is given, the first pending status of each removed goal becomes skipped; if
    there is none, the node fails. It fails with all goals if there are none, or the costmap cannot say.
    Rule: Nav2's plugins/action/remove_in_collision_goals_action.cpp.
    """

    INPUT_PORTS = {
        "input_goals": Port(description="The goals."),
        "cost_threshold": Port(float, default=254.0, description="The least cost that counts as occupied."),
        "use_footprint": Port(
            bool,
            default=True,
            description="Whether the robot's footprint counts, not a point.",
        ),
        "consider_unknown_as_obstacle": Port(
            bool, default=False, description="Whether unknown cells count as occupied."
        ),
        "input_waypoint_statuses": Port(description="The status of each waypoint."),
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "output_goals": Port(description="The goals that are free."),
        "output_waypoint_statuses": Port(description="The statuses, with the removed waypoints marked."),
    }

    goals: Any = None

    def poses(self) -> list[Any]:
        self.goals = self.read("input_goals")
        return poses_from(self.goals)

    def on_failure(self, _error: str) -> Status:
        give(self, "output_goals", self.goals)
        return Status.FAILURE

    def on_costs(self, costs: list[float] | None) -> Status:
        if costs is None:
            give(self, "output_goals", self.goals)
            return Status.FAILURE
        given = self.read("input_waypoint_statuses") if self.is_given("input_waypoint_statuses") else None
        left, statuses = [], list(given or ())
        for pose, cost in zip(self._poses, costs, strict=True):
            if self.is_free(cost):
                left.append(pose)
            elif given is not None and not complete(statuses, pose, "SKIPPED"):
                return Status.FAILURE
        give(self, "output_goals", regrouped(self.goals, left))
        give(self, "output_waypoint_statuses", statuses)
        return Status.SUCCESS
