"""Adds our Python parts of ROS to the path, as for an action."""

from executor.application import compat
from tests.executor.ros.conftest import context

__all__ = ["context"]

compat.install()
