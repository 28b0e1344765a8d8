"""ComputeRoute of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.reading import give
from tree_gardener.nav2.routes import set_route_goal
from tree_gardener.ports import Port
from tree_gardener.status import Status


class ComputeRoute(Nav2Action):
    """Computes a route over the route graph.

    Rule: Nav2's plugins/action/compute_route_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/ComputeRoute"
    ACTION_NAME = "compute_route"
    INPUT_PORTS = {
        "start": Port(description="The start; a text is x;y;yaw in the map."),
        "goal": Port(description="The goal; a text is x;y;yaw in the map."),
        "start_id": Port(int, description="The first node of the route."),
        "goal_id": Port(int, description="The last node of the route."),
        "use_start": Port(
            bool, default=False, description="Whether the start is used; otherwise the robot's pose."
        ),
        "use_poses": Port(bool, default=False, description="Whether poses are used, and not ids of nodes."),
        "server_name": Port(str, description="Name of the action; compute_route if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "route": Port(description="The route."),
        "path": Port(description="The path of the route."),
        "planning_time": Port(description="The time that the planning took."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        set_route_goal(self, goal)

    def give_result(self, result: Any) -> None:
        result = self._type.Result() if result is None else result
        for name in ("path", "route", "planning_time"):
            give(self, name, getattr(result, name))

    def on_cancelled(self, _result: Any) -> Status:
        return super().on_cancelled(None)

    def on_halt(self) -> None:
        self.give_result(None)
