"""Makes the navigation of a world, where Nav2's interfaces are installed."""

from __future__ import annotations

from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rclpy.context import Context

    from executor.navigation.node import Navigation
    from executor.ros.outlet import Outlet
    from executor.world.interface import World


def make_navigation(world: World, context: Context, outlet: Outlet | None = None) -> Navigation | None:
    """Returns the navigation of a world; None if Nav2's interfaces were not built at set-up."""
    if find_spec("nav2_msgs") is None:
        return None
    from executor.navigation.node import Navigation  # noqa: PLC0415 - ROS reads the environment when loaded

    return Navigation(world, context, outlet=outlet)
