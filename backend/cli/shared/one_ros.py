"""Commands that load ROS refuse a shell that has sourced another one, before anything is started."""

from __future__ import annotations

from backend.cli.shared.errors import CliError


def require_one_ros() -> None:
    """Raises an error with what to do if rclpy would be here twice."""
    try:
        import tree_gardener.ros_wheels  # noqa: F401
    except ImportError as error:
        raise CliError(f"bt-studio: {error}") from None
