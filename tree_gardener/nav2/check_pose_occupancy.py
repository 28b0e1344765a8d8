"""CheckPoseOccupancy of Nav2."""

from typing import Any

from tree_gardener.nav2.cost_leaf import Nav2Costs
from tree_gardener.nav2.poses import pose_from
from tree_gardener.ports import Port
from tree_gardener.status import Status


class CheckPoseOccupancy(Nav2Costs):
    """Succeeds if a pose is occupied, and fails if it is free or the costmap cannot say.

    Rule: Nav2's plugins/action/check_pose_occupancy_action.cpp.
    """

    INPUT_PORTS = {
        "pose": Port(description="The pose; a text is x;y;yaw in the map."),
        "cost_threshold": Port(float, default=254.0, description="The least cost that counts as occupied."),
        "use_footprint": Port(
            bool,
            default=True,
            description="Whether the robot's footprint counts, not a point.",
        ),
        "consider_unknown_as_obstacle": Port(
            bool, default=False, description="Whether unknown cells count as occupied."
        ),
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }

    def poses(self) -> list[Any]:
        return [pose_from(self.read("pose"))]

    def on_costs(self, costs: list[float] | None) -> Status:
        return Status.SUCCESS if costs and not self.is_free(costs[0]) else Status.FAILURE
