"""Transforms as CDR are those that ROS writes and reads."""

from __future__ import annotations

import pytest
from rclpy.serialization import deserialize_message
from tf2_msgs.msg import TFMessage

from executor.recorder.cdr import encode_object
from executor.ros import messages
from executor.ros.transform_rows import TF_TYPE, encode_transforms

POSE = (1.0, -2.0, 0.5, 0.0, 0.0, 0.6, 0.8)
NAMES = ("", "a", "odom", "base_footprint", "robot_2/wheel_left_link", "é")


@pytest.mark.parametrize("count", [0, 1, 3])
@pytest.mark.parametrize("parent", NAMES)
@pytest.mark.parametrize("child", NAMES)
def test_the_bytes_are_those_of_the_message(count, parent, child):
    rows = [(parent, child, POSE), (child, parent, POSE[::-1]), (parent, parent, POSE)][:count]
    message = messages.transforms([messages.transform(*row, 12.25) for row in rows])
    data = encode_transforms(rows, 12.25)
    assert data == encode_object(TF_TYPE, message)
    assert deserialize_message(data, TFMessage) == message
