"""World and application in one process, tied by ROS: a message arrives before `publish` returns."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rclpy.parameter import Parameter

from executor.headless.waiting import wait_in_simulation
from executor.navigation.start import make_navigation
from executor.ros.default_context import DefaultContext
from executor.ros.shared_topics import share_commands
from executor.ros.spin import DrainingExecutor
from tree_gardener.ros_node import ActionNode

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context

    from executor.ros.node import WorldNode
    from executor.world.interface import World

__all__ = ["Participants"]

NODE_NAME = "application"


class Participants:
    """The nodes of a world and of its application in rclpy's default context.

    Args:
        world: the world.
        make_node: makes the world's node.
        advance: simulates a short time, while an action waits in rclpy.
    """

    def __init__(
        self, world: World, make_node: Callable[[Context], WorldNode], advance: Callable[[], None]
    ) -> None:
        self._close: list[Callable[[], object]] = []
        default = DefaultContext(simulated=True)
        self.context = default.context
        self._close.append(default.close)
        self.node = make_node(self.context)
        self._close.append(self.node.close)
        self._close.append(share_commands(self.node, self.context))
        self.navigation = make_navigation(world, self.context)
        if self.navigation is not None:
            self._close.append(self.navigation.close)
        self.application = ActionNode(
            NODE_NAME,
            context=self.context,
            parameter_overrides=[Parameter("use_sim_time", Parameter.Type.BOOL, True)],  # noqa: FBT003
        )
        self._close.append(self.application.close)
        self.executor: DrainingExecutor = DrainingExecutor(context=self.context)
        self.executor.add_node(self.application)
        self._close.append(self.executor.shutdown)
        self._close.append(wait_in_simulation(lambda: world.time_s, advance))

    def close(self) -> None:
        """Leaves the graph. May be called twice."""
        while self._close:
            self._close.pop()()
