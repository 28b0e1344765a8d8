"""A client that stops reading costs nothing; later it gets the current state, not old frames."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np

from executor.child_messages import Frame
from executor.messages import Camera, Poses
from executor.stream.outbox import PACE_S, StreamOutbox
from executor.stream.pose_codec import pack, unpack
from tests.executor.manager.test_server import manager
from tests.executor.session_client import SessionClient

_encode = msgspec.msgpack.Encoder().encode
FRAMES = 1500


def picture(number):
    return _encode(Camera(t=float(number), sensor="c", width=4, height=4, jpeg=bytes(60_000)))


def pose_of(number, object_id):
    ids = np.array([object_id], "<u2").tobytes()
    pose = np.array([[number / 100, 0, 0, 0, 0, 0, 1]], np.float32)
    return _encode(Poses(t=float(number), ids=ids, poses=pack(pose)))


async def test_a_client_that_stalls_gets_the_present_when_it_reads_again():
    async with manager() as it:
        client = await SessionClient(it.port).open()
        waiting = it._server._streams[client.id]
        client.stream.transport.pause_reading()
        for number in range(FRAMES):
            it._on_frame(Frame(client.id, "camera", picture(number)))
            # Object 7 moves all the time, object 3 only once, in the middle.
            it._on_frame(Frame(client.id, "poses", pose_of(number, 7)))
            if number == FRAMES // 2:
                it._on_frame(Frame(client.id, "poses", pose_of(number, 3)))
        held = sum(len(data) for data in waiting._frames.values())
        assert len(waiting._frames) <= 2
        assert held < 70_000
        assert await client.ask("connect") == "ack"  # its other socket works

        client.stream.transport.resume_reading()
        last = FRAMES - 1
        await client.until(
            lambda: {type(f) for _, f in client.frames if f.t == last} == {Camera, Poses}, timeout_s=60
        )
        assert len(client.frames) < FRAMES
        places: dict[Any, Any] = {}
        for _, frame in client.frames:
            if isinstance(frame, Poses):
                ids = np.frombuffer(frame.ids, "<u2").tolist()
                places |= {one: unpack(frame.poses[16 * i : 16 * i + 16])[0] for i, one in enumerate(ids)}
        assert places == {7: last / 100, 3: FRAMES // 2 / 100}
        await client.close()


async def test_pictures_of_one_camera_replace_none_of_another():
    outbox = StreamOutbox()
    for lane in ("camera", "camera/rear", "camera/rear"):
        outbox.put(lane, lane.encode() + b"%d" % len(outbox._frames))
    assert [await outbox.take(), await outbox.take()] == [b"camera0", b"camera/rear2"]


async def test_the_share_of_lost_pictures_is_reported_twice_a_second():
    outbox = StreamOutbox()
    outbox.put("poses", pose_of(0, 1))
    assert outbox.lost_share(10.0) is None
    outbox.put("camera", b"1")
    assert outbox.lost_share(10.0) is None
    outbox.put("camera", b"2")
    outbox.put("camera", b"3")
    assert outbox.lost_share(10.0 + PACE_S / 2) is None
    await outbox.take()
    await outbox.take()
    outbox.put("camera", b"4")
    assert outbox.lost_share(10.0 + PACE_S) == 2 / 3
    outbox.put("camera", b"5")
    assert outbox.lost_share(10.0 + 2 * PACE_S) == 1.0
    assert outbox.lost_share(10.0 + 3 * PACE_S) is None
