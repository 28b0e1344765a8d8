"""A world that is recorded over a link."""

from __future__ import annotations

import secrets
from typing import Any

import msgspec

from executor.child_messages import Frame
from executor.messages import Camera
from executor.recorder.link import BATCH_S, Dump, Heard, Mark, Record, Until
from executor.recorder.sources import listen, take_source
from executor.ros.tap import BatchTap
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from executor.world.simulation.recording import KEYFRAME_S, WorldRecorder


class Topics:
    """Takes the place of the ROS node: gives one message when it is tapped."""

    def __init__(self) -> None:
        self.taps: list[Any] = []
        self.topics = {"/scan"}

    def tap(self, tap: Any, *, samples: bool) -> None:
        self.taps.append((tap, samples))


class Others:
    """Takes the place of the tap of a graph, in which others publish one topic at a high rate."""

    closed = 0

    def __init__(self, own: Any, write: Any, note: Any) -> None:
        assert own == {"/scan"}
        self._write = write
        self._note = note
        self.restarts = 0

    def is_due(self, real_s: float) -> bool:
        return real_s > 1.0  # they are taken with each batch anyway

    def poll(self, real_s: float) -> None:
        assert real_s == 0.0
        self._write("/goal", "std_msgs/msg/String", bytes(30_000), 0.5)
        if not self.restarts:
            self._note("/depth is not recorded: it is too large.")
            self.restart()

    def restart(self) -> None:
        self.restarts += 1

    def close(self) -> None:
        Others.closed += 1


def test_scene_poses_dumps_and_pictures_are_sent(monkeypatch):
    monkeypatch.setattr("executor.recorder.link.BATCH_S", 1e-6)
    assert BATCH_S > 0
    address = f"bt-studio-test-{secrets.token_hex(8)}"
    world = BulletWorld(load_builtin("walled_room"))
    node: Any = Topics()
    with listen(address) as listener:
        recorder = WorldRecorder(world, node, BatchTap, address)
        recorder.join(Others)
        recorder.look(0.0)
        recorder.begin("a1")
        source = take_source(listener)
        assert source is not None
        messages: list[Any] = []
        for _ in range(int((KEYFRAME_S + 1) / world.step_s / 8)):
            world.step(8)
            recorder.look(0.0)
            messages += source.messages()
        for t_s in (6.0, 6.01, 6.2):
            camera = Camera(t=t_s, sensor="front", width=2, height=2, jpeg=b"jpeg")
            recorder.picture(Frame("c", "camera/front", msgspec.msgpack.encode(camera)))
        recorder.picture(Frame("c", "view", b""))
        recorder.did("teleop", {"linear": 0.1, "angular": 0.0})
        recorder.look(0.0)
        messages += source.messages()
        source.connection.close()
    recorder.close()
    world_s = world.time_s
    assert Others.closed == 1
    world.close()
    assert messages[0] == Mark("a1")
    assert isinstance(messages[1], Record)
    assert (messages[1].topic, messages[2].topic) == ("/world/scene", "/world/poses")
    dumps = [m.t_ns for m in messages if isinstance(m, Dump)]
    assert len(dumps) == 2
    assert dumps[1] - dumps[0] >= KEYFRAME_S * 1e9
    others = [m for m in messages if isinstance(m, Heard) and m.topic == "/goal"]
    assert sum(len(m.data) for m in others if m.t_ns < 1e9) == 180_000
    step_ns = 8 * world.step_s * 1e9
    # Each was sent in the middle between two looks; a full batch has another look at the same time.
    halves = [round(m.t_ns / step_ns * 2) % 2 for m in others]
    assert halves.count(1) > halves.count(0)
    untils = [m.t_ns for m in messages if isinstance(m, Until)]
    assert untils == sorted(untils)
    assert untils[-1] == round(world.time_s * 1e9)
    lines = [m.fields for m in messages if isinstance(m, Record) and m.name == "Log"]
    assert [line["text"] for line in lines] == [
        "/depth is not recorded: it is too large.",
        "/goal sends more than 200 KB/s; the recording holds a part of it.",
    ]
    pictures = [m for m in messages if isinstance(m, Heard) and m.topic != "/goal"]
    assert [p.topic for p in pictures] == ["/world/camera/front/compressed"] * 2
    (done,) = [m.fields for m in messages if isinstance(m, Record) and m.topic == "/bt/input"]
    assert (done["command"], done["tick"], done["hook"]) == ("teleop", None, -1)
    assert done["stamp"] == round(world_s * 1e9)
    assert len(node.taps) == 1
