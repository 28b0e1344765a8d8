"""The offered Python parts of ROS, on the path as an action finds them."""

from executor.application import compat
from tests.executor.ros.conftest import context

__all__ = ["context"]

compat.install()
