"""The events and frames of a session in a recording."""

from __future__ import annotations

import io
import struct
from typing import Any

from mcap.reader import make_reader
from rosbags.typesys import Stores, get_typestore

from executor.recorder.cdr import decode
from executor.recorder.events import EventRecorder, laser_scan
from executor.recorder.writer import RecordingWriter

NODE = {"type": "Forward", "kind": "action", "node_id": "n", "tree_id": "Main"}
NODES = [
    NODE | {"uid": 1, "parent": 0, "name": "root", "path": "root"},
    NODE | {"uid": 2, "parent": 1, "name": "go", "path": "root/go"},
]
SCAN: dict[str, Any] = {
    "t": 1.5,
    "sensor": "lidar",
    "angle_min": -0.5,
    "angle_increment": 0.5,
    "range_max": 8.0,
} | {"ranges": struct.pack("<3f", 1.0, float("inf"), 2.0)}


def recorded(*events):
    file = io.BytesIO()
    recorder = EventRecorder(writer := RecordingWriter(file, {}))
    for name, data in events:
        recorder.event(name, 1.0, 4, data)
    writer.finish()
    messages = make_reader(io.BytesIO(file.getvalue())).iter_messages()
    return [(channel.topic, decode(schema.name, message.data)) for schema, channel, message in messages]


def test_events_become_messages_that_name_nodes_by_uid():
    entry = {"scope": "", "key": "k", "type": "int", "value": 3, "preview": False, "removed": False}
    said = dict(
        recorded(
            ("tree", {"nodes": NODES}),
            ("tick", {"n": 4, "changed": [(2, "RUNNING")], "flashed": [(1, "SKIPPED")], "duration_ms": 0.5}),
            ("blackboard", {"entries": [entry, entry | {"value": "big", "preview": True}]}),
            (
                "fault",
                {"kind": "exception", "message": "m", "node_path": "root/go", "file": "a.py", "line": 3},
            ),
            ("log", {"source": "action", "level": "info", "text": "hello", "node_path": "root/go"}),
            ("sim", {"speed": 1.0}),
        )
    )
    assert set(said) == {"/bt/tree", "/bt/tick", "/bt/blackboard", "/bt/fault", "/bt/log"}
    assert said["/bt/tree"]["path"] == ["root", "root/go"]
    tick = said["/bt/tick"]
    assert (tick["changed_uid"], tick["changed_status"], tick["flashed_status"]) == ([2], b"\x01", b"\x04")
    assert (tick["number"], tick["generation"]) == (4, 1)
    assert said["/bt/blackboard"]["value_json"] == ["3", '{"preview":"big"}']
    assert (said["/bt/fault"]["uid"], said["/bt/fault"]["line"]) == (2, 3)
    assert (said["/bt/log"]["uid"], said["/bt/log"]["text"]) == (2, "hello")


def test_another_tree_is_another_generation():
    tick = ("tick", {"n": 1, "changed": [], "flashed": []})
    said = recorded(("tree", {"nodes": NODES}), tick, ("tree", {"nodes": NODES[:1]}), tick)
    assert [fields["generation"] for _, fields in said] == [1, 1, 2, 2]


def test_the_end_is_a_line():
    ((topic, line),) = recorded(("finished", {"status": "SUCCESS", "reason": "root_finished", "message": ""}))
    assert (topic, line["text"]) == ("/bt/log", "The tree ended with SUCCESS.")


def test_a_scan_is_one_of_ros():
    read: Any = get_typestore(Stores.ROS2_JAZZY).deserialize_cdr(
        laser_scan(1_500_000_000, SCAN), "sensor_msgs/msg/LaserScan"
    )
    assert (read.header.stamp.sec, read.header.stamp.nanosec, read.header.frame_id) == (
        1,
        500_000_000,
        "lidar",
    )
    assert (read.angle_min, read.angle_max, read.range_max) == (-0.5, 0.5, 8.0)
    assert read.ranges.tolist() == [1.0, float("inf"), 2.0]
