"""The whole state at the end of a recording, from which a segment can begin. Pure."""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["SEGMENT_NS", "Moment"]

SEGMENT_NS: Final = 20_000_000_000
"""The simulated time from the begin of a segment to the next one."""
MOST_ENTRIES: Final = 5000
_decode_poses = msgspec.msgpack.Decoder(Poses).decode
_encode = msgspec.msgpack.Encoder().encode
Message = tuple[str, str, dict[str, Any]]


class Moment:
    """Follows the messages of a run, and makes those that begin a segment."""

    def __init__(self) -> None:
        self._scene = b""
        self._poses: dict[int, bytes] = {}
        self._tree: dict[str, Any] | None = None
        self._uids: dict[str, int] = {}
        self._status: dict[int, int] = {}
        self._blackboard: dict[tuple[str, str], tuple[str, str]] = {}
        self._flags: dict[str, Mapping[str, Any]] = {}
        self._tick = 0

    @property
    def tick(self) -> int:
        """The number of the last tick."""
        return self._tick

    def uid(self, path: str) -> int:
        """Returns the number of the node at a path, or 0."""
        return self._uids.get(path, 0)

    def take(self, name: str, fields: Mapping[str, Any]) -> None:
        """Notes a message of one of our types.

        Raises:
            KeyError, TypeError, ValueError, struct.error: the fields are not those of the type.
        """
        match name:
            case "Scene":
                self._scene, self._poses = fields["data"], {}
            case "Poses":
                self._take_poses(fields["data"])
            case "Tree":
                self._take_tree(dict(fields))
            case "Tick":
                self._tick = fields["number"]
                self._status.update(zip(fields["changed_uid"], fields["changed_status"], strict=True))
            case "Blackboard":
                self._take_entries(fields)
            case "Keyframe":
                self._take_keyframe(fields)
            case "Flag":
                self._flags[fields["id"]] = fields
            case _:
                pass

    def head(self, t_ns: int) -> list[Message]:
        """Returns the messages that begin a segment at a time."""
        head: list[Message] = []
        if self._scene:
            head.append(("/world/scene", "Scene", {"stamp": t_ns, "data": self._scene}))
        if self._poses:
            ids = struct.pack(f"<{len(self._poses)}H", *self._poses)
            data = _encode(Poses(t=t_ns * 1e-9, ids=ids, poses=b"".join(self._poses.values())))
            head.append(("/world/poses", "Poses", {"stamp": t_ns, "data": data}))
        if self._tree is not None:
            head.append(("/bt/tree", "Tree", self._tree | {"stamp": t_ns}))
            head.append(("/bt/keyframe", "Keyframe", self.keyframe(t_ns, 0, b"")))
        flags = [flag for flag in self._flags.values() if flag["text"]]
        head += [("/bt/flag", "Flag", {**flag, "stamp": t_ns}) for flag in flags]
        return head

    def keyframe(self, t_ns: int, step: int, world: bytes) -> dict[str, Any]:
        """Returns the fields of a keyframe with the state of the world."""
        entries = [
            [scope, key, kind, json.loads(text)] for (scope, key), (kind, text) in self._blackboard.items()
        ]
        uids = self._tree["uid"] if self._tree is not None else []
        return {
            "stamp": t_ns,
            "step": step,
            "tick": self._tick,
            "generation": self._tree["generation"] if self._tree is not None else 0,
            "status": bytes(self._status.get(uid, 0) for uid in uids),
            "blackboard_json": json.dumps(entries, ensure_ascii=False, separators=(",", ":")),
            "world": world,
        }

    def _take_poses(self, data: bytes) -> None:
        frame = _decode_poses(data)
        for place, object_id in enumerate(struct.unpack(f"<{len(frame.ids) // 2}H", frame.ids)):
            self._poses[object_id] = frame.poses[place * POSE_BYTES : (place + 1) * POSE_BYTES]

    def _take_tree(self, fields: dict[str, Any]) -> None:
        self._uids = dict(zip(fields["path"], fields["uid"], strict=True))
        self._tree, self._status, self._blackboard = fields, {}, {}

    def _take_entries(self, fields: Mapping[str, Any]) -> None:
        columns = ("scope", "key", "type", "value_json", "removed")
        for scope, key, kind, text, is_removed in zip(*(fields[name] for name in columns), strict=True):
            if is_removed:
                self._blackboard.pop((scope, key), None)
            elif (scope, key) in self._blackboard or len(self._blackboard) < MOST_ENTRIES:
                self._blackboard[scope, key] = (kind, text)

    def _take_keyframe(self, fields: Mapping[str, Any]) -> None:
        if self._tree is None:
            return
        self._tick = fields["tick"]
        self._status = dict(zip(self._tree["uid"], fields["status"], strict=True))
        self._blackboard = {
            (scope, key): (kind, json.dumps(value, ensure_ascii=False, separators=(",", ":")))
            for scope, key, kind, value in json.loads(fields["blackboard_json"])[:MOST_ENTRIES]
        }
