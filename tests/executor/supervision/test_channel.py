"""The channel between the manager and its children."""

from __future__ import annotations

import asyncio
import os
import struct
import threading
from typing import Any

import msgspec
import numpy as np
import pytest

from executor.child_messages import Frame, decode_to_application
from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES, pack, unpack
from executor.supervision import channel as channel_module
from executor.supervision.channel import (
    AsyncChannel,
    Channel,
    ChannelClosed,
    ChannelError,
    encode,
    socket_pair,
)

decode = msgspec.msgpack.decode


@pytest.fixture
def ends():
    ours, theirs = socket_pair()
    child: Channel[Any, Any] = Channel(theirs.detach(), decode)
    yield ours, child
    child.close()
    ours.close()


def read_all(sock, count):
    """Reads `count` messages from the manager's end with a second Channel."""
    peer: Channel[Any, Any] = Channel(sock.detach(), decode)
    try:
        return [peer.receive(5) for _ in range(count)]
    finally:
        peer.close()


def frame(data, client="c1", stream="camera", **more):
    return Frame(client, stream, data, **more)


def send_many(channel, message, count):
    for _ in range(count):
        channel.send(message)


def test_messages_arrive_in_order(ends):
    ours, child = ends
    for n in range(100):
        child.send({"type": "tick", "n": n, "blob": b"x" * n})
    got = read_all(ours, 100)
    assert [m["n"] for m in got] == list(range(100))
    assert got[99]["blob"] == b"x" * 99


def test_receive_returns_none_when_nothing_comes(ends):
    _, child = ends
    assert child.receive(0) is None
    assert child.receive(0.01) is None


def test_a_message_in_pieces_is_one_message(ends):
    ours, child = ends
    by_hand: Any = {"type": "start", "app_dir": "a"}
    data = encode(by_hand)
    for byte in data[:-1]:
        ours.send(bytes([byte]))
        assert child.receive(0) is None
    ours.send(data[-1:])
    assert child.receive(1) == {"type": "start", "app_dir": "a"}


def test_several_messages_in_one_piece(ends):
    ours, child = ends
    both: Any = {"type": "a"}, {"type": "b"}
    ours.send(b"".join(map(encode, both)))
    assert [child.receive(1), child.receive(0)] == [{"type": "a"}, {"type": "b"}]


def test_a_stalled_reader_gets_the_latest_frame_and_all_control_messages(ends):
    ours, child = ends
    payload = bytes(200_000)
    for n in range(50):
        child.send(frame(struct.pack("<I", n) + payload))
        child.send({"type": "log", "text": str(n)})
    got = []
    peer: Channel[Any, Any] = Channel(ours.detach(), decode)
    while (message := peer.receive(1)) is not None:
        got.append(message)
    peer.close()
    logs = [m["text"] for m in got if m["type"] == "log"]
    frames = [struct.unpack_from("<I", m["data"])[0] for m in got if m["type"] == "frame"]
    assert logs == [str(n) for n in range(50)]
    assert frames == sorted(frames)
    assert frames[-1] == 49
    assert len(frames) < 10


def test_kept_frames_are_not_dropped(ends):
    ours, child = ends
    for n in range(20):
        child.send(frame(bytes([n]) * 100_000, keep=True))
    assert [m["data"][0] for m in read_all(ours, 20)] == list(range(20))


def test_poses_that_wait_are_merged(ends):
    ours, child = ends

    def poses(t, **by_id):
        ids = struct.pack(f"<{len(by_id)}H", *(int(k[1:]) for k in by_id))
        data = pack(np.array([[v, 0, 0, 0, 0, 0, 1] for v in by_id.values()], np.float32))
        return frame(msgspec.msgpack.encode(Poses(t=t, ids=ids, poses=data)), stream="poses")

    child.send({"type": "log", "text": "x" * 3_000_000})
    child.send(poses(1.0, b1=1, b2=2))
    child.send(poses(2.0, b2=3, b7=4))
    _, merged = read_all(ours, 2)
    got = msgspec.msgpack.decode(merged["data"], type=Poses)
    assert got.t == 2.0
    assert struct.unpack("<3H", got.ids) == (1, 2, 7)
    assert [unpack(got.poses[at : at + POSE_BYTES])[0] for at in (0, 16, 32)] == [1.0, 3.0, 4.0]


def test_closing_the_other_end_is_noticed(ends):
    ours, child = ends
    ours.close()
    with pytest.raises(ChannelClosed):
        child.receive(1)
    with pytest.raises(ChannelClosed):
        send_many(child, {"type": "log"}, 3)


def test_a_peer_that_never_reads_is_dropped(ends, monkeypatch):
    _, child = ends
    monkeypatch.setattr(channel_module, "STALL_TIMEOUT_S", 0.05)
    monkeypatch.setattr(channel_module, "MAX_QUEUED_BYTES", 100_000)
    with pytest.raises(ChannelClosed):
        send_many(child, {"type": "log", "text": "x" * 10_000}, 200)


@pytest.mark.parametrize("body", [b"\xc1", b"\x01", b"\x80", b"\x81\xa4type\x01", b"\x81\xa4type\xa1x"])
def test_rubbish_is_refused(body):
    ours, theirs = socket_pair()
    child: Channel[Any, Any] = Channel(theirs.detach(), decode_to_application)
    ours.send(struct.pack("<I", len(body)) + body)
    with pytest.raises(ChannelError, match="does not decode"):
        child.receive(1)
    child.close()
    ours.close()


def test_an_absurd_length_is_refused(ends):
    ours, child = ends
    ours.send(b"\xff\xff\xff\xff")
    with pytest.raises(ChannelError, match="too large"):
        child.receive(1)


def test_flush_waits_for_a_slow_reader(ends):
    ours, child = ends
    for _ in range(30):
        child.send({"type": "log", "text": "x" * 100_000})
    got = []
    reader = threading.Thread(target=lambda: got.extend(read_all(ours, 30)))
    reader.start()
    assert child.flush(10)
    reader.join(10)
    assert len(got) == 30


def test_a_forked_child_cannot_write_into_the_channel(ends):
    ours, child = ends
    pid = os.fork()
    if pid == 0:
        try:
            child.send({"type": "from the fork"})
        except ChannelClosed:
            os._exit(0)
        os._exit(1)
    assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0
    child.send({"type": "from the parent"})
    assert read_all(ours, 1) == [{"type": "from the parent"}]


async def test_the_managers_side(ends):
    ours, child = ends
    manager: AsyncChannel[Any, Any] = await AsyncChannel.open(ours, decode)
    manager.send({"type": "start", "seed": 1})
    assert await asyncio.to_thread(child.receive, 5) == {"type": "start", "seed": 1}
    child.send({"type": "ready"})
    assert await manager.receive() == {"type": "ready"}
    child.close()
    with pytest.raises(ChannelClosed):
        await manager.receive()
    manager.close()
    manager.close()
    with pytest.raises(ChannelClosed):
        manager.send({"type": "stop"})


async def test_the_manager_gives_up_a_child_that_does_not_read(ends, monkeypatch):
    ours, _ = ends
    monkeypatch.setattr(channel_module, "MAX_QUEUED_BYTES", 100_000)
    manager: AsyncChannel[Any, Any] = await AsyncChannel.open(ours, decode)
    with pytest.raises(ChannelClosed, match="does not read"):
        send_many(manager, {"type": "teleop", "pad": "x" * 1000}, 2000)
    manager._writer.transport.abort()
