#!/usr/bin/env bash
# Guess: a number of another Python type in a field of a ROS message is converted, or raises TypeError.
# Seen with the wheels of ROS 2 Jazzy (rclpy 7.1.6, common-interfaces 5.3.6): nothing is said and another
# number is sent. An int in a float64 field is read as the bits of a float: 1 arrives as 5e-324, -3 as NaN.
# numpy.float32 in a float32 field arrives as 0.0, while numpy.float64 there is right. Bool(data=2) is False,
# Int8(data=300) is 44. Elements of lists are converted (ranges=[1, 2]). ROS_PYTHON_CHECK_FIELDS=1 checks.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/python -m pip install --quiet --disable-pip-version-check \
  ros-jazzy-rclpy==7.1.6 ros-jazzy-common-interfaces==5.3.6 \
  ros-rmw-fastrtps-cpp==8.4.3 numpy==2.4.6
cat > send.py <<'PYTHON'
import sys

import numpy as np
from geometry_msgs.msg import Vector3
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, Float32, Int8

CASES = {
    "1 in float64": lambda: back(Vector3(x=1)).x,
    "-3 in float64": lambda: back(Vector3(x=-3)).x,
    "True in float64": lambda: back(Vector3(x=True)).x,
    "numpy.float32(1.5) in float32": lambda: back(Float32(data=np.float32(1.5))).data,
    "numpy.float64(1.5) in float32": lambda: back(Float32(data=np.float64(1.5))).data,
    "2 in bool": lambda: back(Bool(data=2)).data,
    "300 in int8": lambda: back(Int8(data=300)).data,
    "[1, 2] in float32[]": lambda: list(back(LaserScan(ranges=[1, 2])).ranges),
}


def back(message):
    return deserialize_message(serialize_message(message), type(message))


for name, case in CASES.items():
    try:
        print(f"{name}: {case()}")
    except AssertionError:
        print(f"{name}: AssertionError")
PYTHON
env/bin/python send.py | tee sent
diff sent - <<'TEXT'
1 in float64: 5e-324
-3 in float64: nan
True in float64: 5e-324
numpy.float32(1.5) in float32: 0.0
numpy.float64(1.5) in float32: 1.5
2 in bool: False
300 in int8: 44
[1, 2] in float32[]: [1.0, 2.0]
TEXT
ROS_PYTHON_CHECK_FIELDS=1 env/bin/python send.py > checked
cat checked
[ "$(grep -c AssertionError checked)" -ge 5 ]
