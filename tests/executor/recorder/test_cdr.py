"""Our messages as CDR, against an independent reader."""

from __future__ import annotations

import numpy as np
import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from executor.recorder.cdr import CdrError, decode, encode, encode_object
from executor.recorder.definitions import OURS, full_text, names_of_ours
from tests.executor.recorder.messages import MESSAGES


def test_every_type_has_an_example():
    assert {f"{OURS}/msg/{name}" for name in MESSAGES} == set(names_of_ours())


@pytest.mark.parametrize("name", MESSAGES)
def test_another_reader_finds_every_field(name):
    kind = f"{OURS}/msg/{name}"
    store = get_typestore(Stores.ROS2_JAZZY)
    text = full_text(kind).partition("=" * 80)[0]
    store.register(get_types_from_msg(text, kind))
    read = store.deserialize_cdr(encode(kind, MESSAGES[name]), kind)
    for field, value in MESSAGES[name].items():
        found = getattr(read, field)
        if field in {"stamp", "moment"}:
            assert (found.sec, found.nanosec) == divmod(value, 10**9)
        elif isinstance(found, np.ndarray):
            assert found.tolist() == list(value), field
        else:
            assert found == value, field


@pytest.mark.parametrize("name", MESSAGES)
def test_a_message_comes_back(name):
    kind = f"{OURS}/msg/{name}"
    assert decode(kind, encode(kind, MESSAGES[name])) == MESSAGES[name]


@pytest.mark.parametrize("name", MESSAGES)
def test_a_cut_message_is_an_error_at_every_byte(name):
    kind = f"{OURS}/msg/{name}"
    data = encode(kind, MESSAGES[name])
    for length in range(len(data)):
        with pytest.raises(CdrError, match=kind):
            decode(kind, data[:length])


def test_a_list_that_claims_more_than_the_message_holds_is_refused():
    kind = f"{OURS}/msg/Poses"
    data = bytearray(encode(kind, MESSAGES["Poses"]))
    data[12:16] = b"\xff\xff\xff\x7f"
    with pytest.raises(CdrError, match="a list of 2147483647 items"):
        decode(kind, bytes(data))


def ros_messages():
    from geometry_msgs.msg import PoseWithCovariance, Twist, TwistStamped
    from sensor_msgs.msg import CompressedImage, Imu, JointState, LaserScan, NavSatFix
    from std_msgs.msg import Bool, Header, String

    header = Header(frame_id="base_link")
    header.stamp.sec, header.stamp.nanosec = 3, 7
    twist = Twist()
    twist.linear.x, twist.angular.z = 0.25, -1.5
    scan = LaserScan(header=header, angle_min=-1.0, ranges=[1.0, float("inf"), 0.5], intensities=[])
    joints = JointState(header=header, name=["left", "right"], position=[1.0, 2.0], velocity=[], effort=[])
    pose = PoseWithCovariance(covariance=[float(i) for i in range(36)])
    picture = CompressedImage(header=header, format="jpeg", data=b"\xff\xd8")
    return [
        *(twist, TwistStamped(header=header, twist=twist), scan, joints, pose, picture),
        *(Imu(header=header), NavSatFix(header=header), Bool(data=True), String(data="é")),
    ]


@pytest.mark.parametrize("number", range(10))
def test_messages_of_ros_are_read_by_ros_itself(number):
    from rclpy.serialization import deserialize_message

    from executor.ros.tap import kind_of

    message = ros_messages()[number]
    data = encode_object(kind_of(message), message)
    assert deserialize_message(data, type(message)) == message
    assert get_typestore(Stores.ROS2_JAZZY).deserialize_cdr(data, kind_of(message)) is not None
