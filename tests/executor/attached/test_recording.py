"""The transitions of another program are recorded as ticks of the session's time."""

from __future__ import annotations

import socket
import struct
from typing import Any

import msgspec

from executor.attached.recording import AttachedRecorder
from executor.messages import TreeNode
from executor.recorder.link import Dump, Heard, Mark, Record, Until
from tree_gardener.status import Status

NODES = [
    TreeNode(1, 0, "Sequence", "Control", "top", "top", "u7", "Main"),
    TreeNode(2, 1, "Wait", "Action", "wait", "wait", "u8", "Main"),
]
decode = msgspec.msgpack.Decoder(list[Mark | Record | Heard | Dump | Until]).decode


class Taker:
    """The end of the recorder."""

    def __init__(self, name: str) -> None:
        self.listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.listener.bind(f"\0{name}")
        self.listener.listen()

    def take(self, recorder: AttachedRecorder) -> list[Any]:
        connection, _ = self.listener.accept()
        recorder.close()
        data = b"".join(iter(lambda: connection.recv(1 << 16), b""))
        found: list[Any] = []
        while data:
            (length,) = struct.unpack_from("<I", data)
            found += decode(data[4 : 4 + length])
            data = data[4 + length :]
        connection.close()
        self.listener.close()
        return found


def test_transitions_become_ticks_that_begin_with_the_tree() -> None:
    taker = Taker("bts-test-attached-recorder")
    recorder = AttachedRecorder(NODES, {7: 1, 8: 2}, "bts-test-attached-recorder")
    recorder.begin("run1")
    assert recorder.is_wanted
    recorder.correct({7: Status.RUNNING}, 1.0)
    recorder.written([("", "a", "int", "1", False)], 1.0)
    recorder.take([(10_000, 0, 8, 1), (90_000, 0, 8, 2), (95_000, 0, 99, 2)], 1.0, 2.0)
    found = taker.take(recorder)
    assert isinstance(found[0], Mark)
    records = [each for each in found if isinstance(each, Record)]
    assert [each.name for each in records[:2]] == ["Tree", "Keyframe"]
    assert records[0].fields["node_id"] == ["u7", "u8"]
    ticks = [each.fields for each in records if each.name == "Tick"]
    assert [(tick["stamp"], tick["changed_uid"], list(tick["changed_status"])) for tick in ticks] == [
        (1_000_000_000, [1], [1]),
        (1_010_000_000, [2], [1]),
        (1_090_000_000, [2], [2]),
    ]
    [board] = [each.fields for each in records if each.name == "Blackboard"]
    assert (board["key"], board["value_json"]) == (["a"], ["1"])


def test_nothing_is_sent_without_a_recorder() -> None:
    recorder = AttachedRecorder(NODES, {7: 1, 8: 2}, "")
    recorder.begin("run1")
    recorder.take([(0, 0, 7, 1)], 0.0, 1.0)
    recorder.pump()
    recorder.close()
    assert recorder.is_wanted
