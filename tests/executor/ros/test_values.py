import math
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseWithCovariance, Twist
from nav_msgs.msg import Path
from sensor_msgs.msg import CameraInfo, Image, JointState, LaserScan
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import String, UInt8MultiArray

from executor.ros.values import (
    LARGEST_LIST,
    LARGEST_TEXT,
    MOST_VALUES,
    FieldError,
    fill,
    flatten,
    message_type,
    type_name,
)

KINDS = [
    CameraInfo, DiagnosticStatus, Image, JointState, LaserScan, Path, PoseWithCovariance, SolidPrimitive,
    String, Twist, UInt8MultiArray,
]  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_a_type_is_found_by_its_name(kind: Any) -> None:
    assert message_type(type_name(kind)) is kind
    assert type_name(LaserScan) == "sensor_msgs/msg/LaserScan"


@pytest.mark.parametrize("kind", KINDS)
def test_values_survive_a_round_trip(kind: Any) -> None:
    message = kind()
    fill(message, flatten(kind()).value)
    assert message == kind()


def test_lists_of_messages_and_numbers_are_filled() -> None:
    path = Path()
    fill(path, {"poses": [{"header": {"frame_id": "map"}}, {"pose": {"position": {"x": 3}}}]})
    assert [p.header.frame_id for p in path.poses] == ["map", ""]
    assert path.poses[1].pose.position.x == 3.0
    scan = LaserScan()
    fill(scan, {"ranges": [1, 2.5, "inf"], "angle_min": "nan"})
    assert list(scan.ranges) == [1.0, 2.5, math.inf]
    assert math.isnan(scan.angle_min)
    status = DiagnosticStatus()
    fill(status, {"level": 2, "values": [{"key": "a", "value": "b"}]})
    assert status.level == b"\x02"


@pytest.mark.parametrize(
    ("kind", "values", "text"),
    [
        (String, {"data": 5}, "data: must be text, not a number 5"),
        (String, {"data": "a\0b"}, "data: must not contain the character NUL"),
        (String, {"dat": "x"}, "dat: String has no field 'dat'; it has data"),
        (String, ["x"], "message: must be an object with fields, not a list"),
        (Twist, {"linear": {"x": "fast"}}, "linear.x: must be a number, not text 'fast'"),
        (Twist, {"linear": {"x": True}}, "linear.x: must be a number, not true or false True"),
        (Twist, {"linear": None}, "linear: must be an object with fields, not null"),
        (LaserScan, {"angle_min": 1e39}, r"angle_min: is larger than 3.4e\+38"),
        (LaserScan, {"ranges": [1, "x"]}, r"ranges\[1\]: must be a number"),
        (LaserScan, {"ranges": 1}, "ranges: must be a list"),
        (Image, {"height": -1}, "height: must be from 0 to 4294967295, not -1"),
        (Image, {"height": 1.5}, "height: must be a whole number"),
        (Image, {"data": [256]}, r"data\[0\]: must be from 0 to 255"),
        (CameraInfo, {"k": [1.0]}, "k: must have 9 values, not 1"),
        (SolidPrimitive, {"dimensions": [1.0] * 4}, "dimensions: must have at most 3 values, not 4"),
        (Path, {"poses": [{}, {"pose": {"position": {"w": 1}}}]}, r"poses\[1\].pose.position.w: Point has"),
    ],
)
def test_misfits_are_refused_with_their_place(kind: Any, values: Any, text: str) -> None:
    with pytest.raises(FieldError, match=f"^{text}"):
        fill(kind(), values)


def test_long_values_are_shortened_and_marked() -> None:
    flat = flatten(Image(data=bytes(5000), encoding="x" * 9000))
    assert len(flat.value["data"]) == LARGEST_LIST
    assert len(flat.value["encoding"]) == LARGEST_TEXT
    assert flat.cut == {"data": 5000, "encoding": 9000}
    path = Path()
    fill(path, {"poses": [{} for _ in range(2 * MOST_VALUES)]})
    flat = flatten(path)
    assert len(flat.value["poses"]) <= LARGEST_LIST
    assert flat.cut == {"poses": 2 * MOST_VALUES}
