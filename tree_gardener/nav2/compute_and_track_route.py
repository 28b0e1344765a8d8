"""ComputeAndTrackRoute of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.reading import give
from tree_gardener.nav2.routes import set_route_goal
from tree_gardener.ports import Port
from tree_gardener.status import Status


class ComputeAndTrackRoute(Nav2Action):
    """Computes a route over the route graph, and reports where on it the robot is.

    Rule: Nav2's plugins/action/compute_and_track_route_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/ComputeAndTrackRoute"
    ACTION_NAME = "compute_and_track_route"
    INPUT_PORTS = {
        "start": Port(description="The start; a text is x;y;yaw in the map."),
        "goal": Port(description="The goal; a text is x;y;yaw in the map."),
        "start_id": Port(int, description="The first node of the route."),
        "goal_id": Port(int, description="The last node of the route."),
        "use_start": Port(
            bool, default=False, description="Whether the start is used; otherwise the robot's pose."
        ),
        "use_poses": Port(bool, default=False, description="Whether poses are used, and not ids of nodes."),
        "server_name": Port(
            str, description="Name of the action; compute_and_track_route if it is not given."
        ),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "execution_duration": Port(description="The time that the route took."),
        "last_node_id": Port(int, description="The last node that was reached."),
        "next_node_id": Port(int, description="The next node."),
        "current_edge_id": Port(int, description="The edge on which the robot is."),
        "route": Port(description="The route."),
        "path": Port(description="The path of the route."),
        "rerouted": Port(bool, description="Whether the route changed."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    sent_goal: Any = None

    def set_goal(self, goal: Any) -> None:
        set_route_goal(self, goal)
        self.sent_goal = goal

    def is_changed(self) -> bool:
        goal = self._type.Goal()
        set_route_goal(self, goal)
        return bool(goal != self.sent_goal)

    def on_feedback(self, feedback: Any) -> Status:
        for name in ("last_node_id", "next_node_id", "current_edge_id", "route", "path", "rerouted"):
            give(self, name, getattr(feedback, name))
        return Status.RUNNING

    def give_result(self, result: Any) -> None:
        self.on_feedback(self._type.Feedback())
        result = self._type.Result() if result is None else result
        give(self, "execution_duration", result.execution_duration)

    def on_cancelled(self, _result: Any) -> Status:
        return super().on_cancelled(None)
