"""The world process over its channel, as the manager drives it."""

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import pytest

from executor.messages import Poses, Scene, Sim
from executor.ros.environment import ros_environment
from executor.stream.pose_codec import POSE_BYTES, unpack
from executor.supervision.channel import Channel, socket_pair
from tests.domains import own_domain_id
from tests.executor.forks import FORKS

ROOT = Path(__file__).parents[3]
DOMAIN_ID = own_domain_id()
decode = msgspec.msgpack.Decoder(Scene | Poses).decode


class Remote:
    """A world process, and its messages."""

    def __init__(self) -> None:
        ours, theirs = socket_pair()
        environment = {**os.environ, **ros_environment(DOMAIN_ID)}
        with theirs:
            files = (0, 1, 2, theirs.fileno())
            self.process = FORKS.start("executor.world.process", ["--channel-fd", "3"], environment, *files)
        self.channel: Channel[Any, Any] = Channel(ours.detach(), msgspec.msgpack.decode)

    def tell(self, kind: str, **fields: Any) -> None:
        self.channel.send({"type": kind, **fields})

    def start(self, universe: str = "walled_room", **fields: Any) -> None:
        self.tell("start", universe=universe, seed=1, speed=1.0, domain_id=DOMAIN_ID, **fields)

    def hear(self, kind: str, **fields: Any) -> dict[str, Any]:
        """Returns the next message of a type with these fields; others are skipped."""
        while True:
            message = self.channel.receive(60)
            assert message is not None, f"no {kind} came"
            if message["type"] == kind and message.items() >= fields.items():
                return message

    def close(self) -> None:
        self.channel.close()
        self.process.wait(30)


@pytest.fixture(scope="module")
def shared() -> Iterator[Remote]:
    remote = Remote()
    yield remote
    remote.close()


@pytest.fixture
def remote(shared: Remote) -> Remote:
    """Yields the running world, paused at time zero."""
    if not hasattr(shared, "started"):
        shared.tell("pause")
        assert shared.hear("error")["code"] == "not_started"
        shared.start("walled_rom")
        refusal = shared.hear("error")
        assert (refusal["code"], refusal["hint"]) == ("BTU004", "did you mean 'walled_room'?")
        shared.start()
        ready = shared.hear("ready")
        assert ready["universe"] == "Walled room"
        assert ready["renderer"]
        shared.started = True  # type: ignore[attr-defined]
    shared.tell("pause")
    shared.tell("reset")
    return shared


def poses_until(remote: Remote, client: str, x_m: float) -> float:
    """Waits until the robot has reached a position; returns the simulated time."""
    scene = None
    while True:
        message = remote.hear("frame", client=client)
        frame = decode(message["data"])
        if isinstance(frame, Scene):
            scene = frame
            continue
        assert scene is not None
        base = next(o.id for o in scene.objects if o.link == "base_link")
        ids = memoryview(frame.ids).cast("H").tolist()
        if base in ids:
            at = ids.index(base) * POSE_BYTES
            row = unpack(frame.poses[at : at + POSE_BYTES])
            if row[0] >= x_m:
                return frame.t


def test_a_resumed_world_moves_and_is_seen(remote: Remote) -> None:
    remote.tell("subscribe", client="a", stream="poses", max_hz=60.0, width=None, camera_pose=None)
    remote.tell("resume")
    remote.tell("teleop", linear=0.5, angular=0.0)
    assert poses_until(remote, "a", 0.02) > 0
    remote.tell("unsubscribe", client="a", stream="poses")


def test_a_paused_world_steps_on_request(remote: Remote) -> None:
    remote.tell("teleop", linear=0.5, angular=0.0)
    remote.tell("step", dt_s=0.5)
    remote.tell("subscribe", client="b", stream="poses", max_hz=60.0, width=None, camera_pose=None)
    assert poses_until(remote, "b", 0.05) == pytest.approx(0.5)
    remote.tell("unsubscribe", client="b", stream="poses")


def test_a_paused_world_runs_while_a_client_drives(remote: Remote) -> None:
    remote.tell("subscribe", client="c", stream="poses", max_hz=60.0, width=None, camera_pose=None)
    remote.tell("teleop", linear=0.5, angular=0.0, goes_on=True)
    assert poses_until(remote, "c", 0.02) > 0
    remote.tell("unsubscribe", client="c", stream="poses")


def test_reports_are_valid_sim_messages(remote: Remote) -> None:
    report = msgspec.convert(remote.hear("sim"), Sim)
    assert report.paused
    assert report.collisions == 0


def test_a_bump_is_logged(remote: Remote) -> None:
    remote.tell("move_body", id="robot", pose=[4.6, 2.0, 0, 0, 0, 0])
    remote.tell("teleop", linear=0.6, angular=0.0)
    for _ in range(4):
        remote.tell("teleop", linear=0.6, angular=0.0)
        remote.tell("step", dt_s=0.5)
    assert "bumped into wall_east" in remote.hear("log")["text"]


def test_invalid_requests_are_refused_and_the_world_continues(remote: Remote) -> None:
    requests: Any = [
        ("set_speed", {"speed": -1}),
        ("move_body", {"id": "ghost", "pose": [0, 0, 0, 0, 0, 0]}),
        ("echo_topic", {"topic": "/ghost", "max_hz": 1.0}),
        ("start", {"universe": "empty"}),
    ]
    for kind, fields in requests:
        remote.tell(kind, **fields)
        assert remote.hear("error")["message"]
    remote.tell("list_topics")
    names = {row["name"] for row in remote.hear("topics")["topics"]}
    assert {"/scan", "/cmd_vel", "/odom", "/clock", "/camera/image_raw"} <= names


@pytest.mark.parametrize(
    ("kind", "fields"),
    [
        ("nonsense", {}),
        ("step", {}),
        ("subscribe", {"client": "a", "stream": "smell"}),
        ("subscribe", {"client": "a", "stream": "view", "camera_pose": {"eye": 3}}),
    ],
)
def test_a_message_that_does_not_decode_ends_the_process(
    kind: str, fields: dict[str, Any], capfd: pytest.CaptureFixture[str]
) -> None:
    remote = Remote()
    remote.tell(kind, **fields)
    assert remote.process.wait(60) == 1
    assert "cannot be read: a message does not decode" in capfd.readouterr().err
    remote.close()


def test_a_document_that_is_wrong_is_refused_with_its_line() -> None:
    remote = Remote()
    document = "format: bt-studio/universe\nversion: 1\nname: x\nmodels: [{id: a}]\n"
    remote.start(document, file="universes/mine.yaml")
    refusal = remote.hear("error")
    assert "universes/mine.yaml:4:" in refusal["message"]
    remote.tell("stop")
    assert remote.process.wait(30) == 0
    remote.close()


def test_it_ends_with_its_manager() -> None:
    remote = Remote()
    remote.channel.close()
    assert remote.process.wait(30) == 0
