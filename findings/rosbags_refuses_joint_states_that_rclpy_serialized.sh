#!/usr/bin/env bash
# Guess: bytes of rclpy.serialization.serialize_message are what a publisher sends, and any reader of CDR takes them.
# Seen with the wheels ros-jazzy-rclpy 7.1.6 and rosbags 0.11.9: a JointState with names and positions, but without
# velocities and efforts, has 8 bytes more than what its publisher sends. rclpy reads both; rosbags, which allows 3
# bytes at the end, refuses the longer ("size mismatch"). The length is an estimate that aligns an empty list of
# 8-byte numbers at the end. So a recording that a program writes by serialize_message holds joint states
# and trajectories that rosbags does not read, while one recorded from the topic is read.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  ros-jazzy-rclpy==7.1.6 ros-jazzy-common-interfaces==5.3.6 \
  ros-rmw-fastrtps-cpp==8.4.3 rosbags==0.11.9 numpy==2.4.6
env/bin/python - <<'PYTHON'
import os
import time

os.environ["ROS_DOMAIN_ID"] = "94"
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"

import rclpy
from rclpy.serialization import deserialize_message, serialize_message
from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

TYPES = get_typestore(Stores.ROS2_JAZZY)


def is_read(data, message):
    kind = type(message)
    try:
        TYPES.deserialize_cdr(data, f"{kind.__module__.partition('.')[0]}/msg/{kind.__name__}")
    except SerdeError as error:
        assert "size mismatch" in str(error), error
        return False
    return True


state = JointState(name=["wheel"], position=[1.0])
rclpy.init()
node = rclpy.create_node("listener")
heard = []
node.create_subscription(JointState, "/joint_states", heard.append, 10, raw=True)
publisher = node.create_publisher(JointState, "/joint_states", 10)
deadline = time.monotonic() + 60
while not heard and time.monotonic() < deadline:
    publisher.publish(state)
    rclpy.spin_once(node, timeout_sec=0.2)
written, sent = serialize_message(state), heard[0]
print("serialized", len(written), "bytes, sent", len(sent))
assert len(written) == len(sent) + 8
assert deserialize_message(written, JointState) == deserialize_message(sent, JointState) == state
assert is_read(sent, state)
for message, expected in (
    (state, False),
    (JointState(name=["wheel"], position=[1.0], velocity=[2.0], effort=[3.0]), True),
    (JointTrajectory(joint_names=["arm"], points=[JointTrajectoryPoint(positions=[1.0])]), False),
    (Float64MultiArray(data=[1.0]), True),
):
    found = is_read(serialize_message(message), message)
    print(type(message).__name__, "is read" if found else "is refused")
    assert found == expected
rclpy.shutdown()
PYTHON
