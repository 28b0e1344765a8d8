"""A buffer of transforms."""

import pytest
from rclpy.time import Time

from tests.executor.ros_python.tf2_py.test_core import at, plain, stamped


def test_a_transform_is_found_or_the_error_says_why() -> None:
    from tf2_ros import LookupException
    from tf2_ros.buffer import Buffer

    buffer = Buffer()
    buffer.set_transform(stamped("map", "base", plain(2.0)), "test")
    assert buffer.can_transform("map", "base", Time())
    assert buffer.lookup_transform("map", "base", at(1.0)).transform.translation.x == pytest.approx(2.0)
    with pytest.raises(LookupException):
        buffer.lookup_transform("map", "nowhere", Time())
