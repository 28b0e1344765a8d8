"""ValidatePath of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Service, put
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class ValidatePath(Nav2Service):
    """Succeeds if no pose of the path is occupied.

    Rule: Nav2's plugins/action/validate_path_action.cpp.
    """

    SERVICE_TYPE = "nav2_msgs/srv/IsPathValid"
    SERVICE_NAME = "is_path_valid"
    INPUT_PORTS = {
        "path": Port(description="The path."),
        "max_cost": Port(int, default=254, description="The largest cost that is allowed."),
        "consider_unknown_as_obstacle": Port(
            bool, default=False, description="Whether unknown cells count as occupied."
        ),
        "layer_name": Port(str, default="", description="The layer of the costmap."),
        "footprint": Port(str, default="", description="The robot's footprint."),
        "stop_at_first_collision": Port(
            bool, default=True, description="Whether it ends at the first collision."
        ),
        "max_lookahead_distance": Port(
            float, default=-1.0, description="How far along the path it looks, in m; -1 is to the end."
        ),
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "collision_poses": Port(description="The poses that are occupied."),
    }

    path: Any = None

    def set_request(self, request: Any) -> None:
        request.path = self.path = self.read("path")
        put(
            request,
            max_cost=int(self.read("max_cost", 254)),
            consider_unknown_as_obstacle=self.read("consider_unknown_as_obstacle", otherwise=False),
            layer_name=str(self.read("layer_name", "")),
            footprint=str(self.read("footprint", "")),
            stop_at_first_collision=self.read("stop_at_first_collision", otherwise=True),
            max_lookahead_distance=float(self.read("max_lookahead_distance", -1.0)),
        )

    def on_response(self, response: Any) -> Status:
        indices = getattr(response, "invalid_pose_indices", ())
        give(self, "collision_poses", [self.path.poses[index] for index in indices])
        return Status.SUCCESS if response.is_valid else Status.FAILURE
