"""Records a run by the events and frames that a client received, as older versions did.

Pure but for the writer.

Events hold less than the tree itself: a value of the blackboard is the last one of 0.1 s, without its writer,
and ticks without a change come at a limited rate.
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.cdr import HEADER, stamp_of
from executor.recorder.event_messages import message_of
from executor.recorder.values import canonical
from executor.recorder.writer import nanoseconds

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.recorder.writer import RecordingWriter

__all__ = ["CODES", "EventRecorder", "laser_scan"]

CODES: Final = {"IDLE": 0, "RUNNING": 1, "SUCCESS": 2, "FAILURE": 3, "SKIPPED": 4}


class EventRecorder:
    """Writes events and frames into a recording."""

    def __init__(self, writer: RecordingWriter) -> None:
        self._writer = writer
        self._generation = 0
        self._uids: dict[str, int] = {}

    def event(self, name: str, t_s: float, tick: int, data: Mapping[str, Any]) -> None:
        """Writes an event of the control socket; those without a place in a recording are left out.

        Raises:
            KeyError, TypeError, ValueError: the data are not those of the event.
        """
        stamp = {"stamp": nanoseconds(t_s)}
        match name:
            case "tree":
                self._tree(stamp, data["nodes"])
            case "tick":
                self._tick(stamp, data)
            case "blackboard":
                self._blackboard(stamp, tick, data["entries"])
            case _ if (line := message_of(name, stamp["stamp"], data, self._uid(data))) is not None:
                self._record(*line)
            case _:
                pass

    def frame(self, stream: str, t_s: float, data: bytes) -> None:
        """Writes a frame `scene` or `poses` in the encoded form of the stream socket."""
        if stream == "scene":
            self._writer.scene(nanoseconds(t_s), data)
        else:
            self._record("/world/poses", "Poses", {"stamp": nanoseconds(t_s), "data": data})

    def scan(self, frame: Mapping[str, Any]) -> None:
        """Writes a scan of the stream as `sensor_msgs/LaserScan`."""
        t_ns = nanoseconds(frame["t"])
        self._writer.write("/scan", "sensor_msgs/msg/LaserScan", t_ns, laser_scan(t_ns, frame))

    def _record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        self._writer.record(topic, name, fields)

    def _uid(self, data: Mapping[str, Any]) -> int:
        return self._uids.get(data.get("node_path") or "", 0)

    def _tree(self, stamp: dict[str, int], nodes: list[Mapping[str, Any]]) -> None:
        self._generation += 1
        self._uids = {node["path"]: node["uid"] for node in nodes}
        columns = ("uid", "parent", "type", "kind", "name", "path", "node_id", "tree_id")
        fields: dict[str, Any] = {column: [node[column] for node in nodes] for column in columns}
        fields |= {"generation": self._generation, "ports_json": ["{}"] * len(nodes)}
        self._record("/bt/tree", "Tree", stamp | fields)

    def _tick(self, stamp: dict[str, int], data: Mapping[str, Any]) -> None:
        fields: dict[str, Any] = {"generation": self._generation, "number": data["n"], "fingerprint": 0}
        fields["duration_ms"] = data.get("duration_ms") or 0.0
        for part in ("changed", "flashed"):
            pairs = data.get(part) or []
            fields[f"{part}_uid"] = [uid for uid, _ in pairs]
            fields[f"{part}_status"] = bytes(CODES[status] for _, status in pairs)
        self._record("/bt/tick", "Tick", stamp | fields)

    def _blackboard(self, stamp: dict[str, int], tick: int, entries: list[Mapping[str, Any]]) -> None:
        fields: dict[str, Any] = {
            "tick": tick,
            "scope": [entry["scope"] for entry in entries],
            "key": [entry["key"] for entry in entries],
            "type": [entry["type"] for entry in entries],
            "value_json": [_value(entry) for entry in entries],
            "removed": [bool(entry.get("removed")) for entry in entries],
            "writer_uid": [0] * len(entries),
        }
        self._record("/bt/blackboard", "Blackboard", stamp | fields)


def _value(entry: Mapping[str, Any]) -> str:
    value = entry.get("value")
    if entry.get("preview"):
        return json.dumps({"preview": str(value)}, ensure_ascii=False, separators=(",", ":"))
    return canonical(value) or "null"


def laser_scan(t_ns: int, frame: Mapping[str, Any]) -> bytes:
    """Returns a scan of the stream as the CDR of `sensor_msgs/LaserScan`.

    The stream names the sensor and not its frame, so `frame_id` is the sensor; times within a scan are 0.
    """
    name = frame["sensor"].encode() + b"\0"
    ranges: bytes = frame["ranges"]
    count = len(ranges) // 4
    data: bytes = struct.pack("<iII", *stamp_of(t_ns), len(name)) + name
    data += bytes(-len(data) % 4)
    end = frame["angle_min"] + (count - 1) * frame["angle_increment"]
    data += struct.pack("<4f", frame["angle_min"], end, frame["angle_increment"], 0.0)
    data += struct.pack("<3fI", 0.0, 0.0, frame["range_max"], count) + ranges[: count * 4]
    return HEADER + data + struct.pack("<I", 0)
