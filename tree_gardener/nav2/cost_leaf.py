"""The base of Nav2's leaves that ask a costmap for the costs of poses."""

import math
from importlib import import_module
from typing import Any, Final

from tree_gardener.errors import PortError
from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.nav2.poses import FRAME
from tree_gardener.status import Status

UNKNOWN: Final = 255
"""The cost of a cell of which nothing is known."""


class Nav2Costs(Nav2Service):
    """Asks for the costs of `poses`, and gives them to `on_costs`.

    Nav2 has asked for all poses at once (``GetCosts``) since Kilted. Jazzy has only ``GetCost``, for one pose
    in the costmap's frame, under the same name: then one request follows the other.
    """

    SERVICE_TYPE = "nav2_msgs/srv/GetCost"
    SERVICE_NAME = "/global_costmap/get_cost_global_costmap"

    _poses: list[Any]
    _costs: list[float]

    # The next two are abstract: each of Nav2's two nodes has its own.

    def poses(self) -> list[Any]:
        """Returns the stamped poses, as the ports say now."""
        raise NotImplementedError

    def on_costs(self, _costs: list[float] | None) -> Status:
        """Returns the result for the cost of each pose; `_costs` is None if the costmap cannot say."""
        raise NotImplementedError

    def is_free(self, cost: float) -> bool:
        """Returns whether a cost is allowed."""
        if cost == UNKNOWN and not self.read("consider_unknown_as_obstacle"):
            return True
        return cost < float(self.read("cost_threshold"))

    def initialise(self) -> None:
        self._poses, self._costs = self.poses(), []
        super().initialise()

    def set_request(self, request: Any) -> Any:
        if not self._poses:
            return False
        request.use_footprint = bool(self.read("use_footprint"))
        if hasattr(request, "poses"):
            request.poses = self._poses
            return request
        pose = self._poses[len(self._costs)]
        if pose.header.frame_id.removeprefix("/") not in {"", FRAME}:
            raise PortError(
                f"the pose is in the frame '{pose.header.frame_id}'; the service GetCost of this Nav2 needs "
                f"it in {FRAME}"
            )
        turn = pose.pose.orientation
        # rclpy ends the process at an int where the field is a float.
        request.x, request.y = float(pose.pose.position.x), float(pose.pose.position.y)
        request.theta = math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2))
        return request

    def on_response(self, response: Any) -> Any:
        if hasattr(response, "costs"):
            return self.on_costs(list(response.costs) if response.success else None)
        if response.cost < 0:  # outside of the map
            return self.on_costs(None)
        self._costs.append(response.cost)
        if len(self._costs) == len(self._poses):
            return self.on_costs(self._costs)
        self._answer = None
        return self._call()

    def _resolve(self) -> None:
        if self._type is None:
            self.joined()
            self._type = self.interface("service_type", f"nav2_msgs/srv/{_service()}", "srv")


def _service() -> str:
    """Returns the name of the service's type in the installed interfaces."""
    try:
        services = import_module("nav2_msgs.srv")
    except ImportError:
        return "GetCost"
    return "GetCosts" if hasattr(services, "GetCosts") else "GetCost"
