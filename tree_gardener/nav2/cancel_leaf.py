"""The base of Nav2's leaves that cancel the goals of an action, after ``BtCancelActionNode``."""

from typing import Any, ClassVar, Final

from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.status import Status

GOALS_BEFORE_NS: Final = 10_000_000
"""Goals that are younger are left alone, as in Nav2: the server may not have answered yet."""


class Nav2Cancel(Nav2Service):
    """Asks an action server to cancel all its goals, of any client; succeeds with its answer."""

    SERVICE_TYPE = "action_msgs/srv/CancelGoal"
    ACTION_NAME: ClassVar[str] = ""

    def text(self, name: str, default: str) -> str:
        """Returns a port's value; the service is that of the action."""
        if name != "service_name":
            return super().text(name, default)
        return f"{super().text('server_name', self.ACTION_NAME)}/_action/cancel_goal"

    def literal(self, name: str) -> str | None:
        """Returns a port's text unless it names an entry; the service is known when the action is."""
        if name != "service_name" or not self.is_given("server_name"):
            return self.ACTION_NAME if name == "service_name" else super().literal(name)
        return super().literal("server_name")

    def set_request(self, request: Any) -> None:
        """Requests the cancellation of all goals that were accepted up to the present time."""
        now_ns = max(0, self.joined().get_clock().now().nanoseconds - GOALS_BEFORE_NS)
        stamp = request.goal_info.stamp
        stamp.sec, stamp.nanosec = divmod(now_ns, 1_000_000_000)

    def on_response(self, _response: Any) -> Status:
        """Succeeds, also if there was nothing to cancel."""
        return Status.SUCCESS
