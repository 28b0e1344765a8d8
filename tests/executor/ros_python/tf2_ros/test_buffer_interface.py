"""Messages that are transformed by their type."""

import pytest
from geometry_msgs.msg import PointStamped

from tests.executor.ros_python.tf2_py.test_core import plain, stamped


def test_a_type_must_be_registered_before_it_is_transformed() -> None:
    import tf2_geometry_msgs  # noqa: F401 - registers
    from tf2_ros.buffer import Buffer
    from tf2_ros.buffer_interface import TransformRegistration, TypeException

    buffer = Buffer()
    buffer.set_transform_static(stamped("map", "base", plain(2.0)), "test")
    point = PointStamped()
    point.header.frame_id = "base"
    point.point.x = 1.0
    assert buffer.transform(point, "map").point.x == pytest.approx(3.0)
    with pytest.raises(TypeException):
        TransformRegistration().get(str)
