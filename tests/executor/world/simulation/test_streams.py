"""Streams over a real world with pictures of one colour: the frames, their times and their size."""

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
import pytest
import simplejpeg
from numpy.typing import NDArray

from executor.messages import FRAMES, Camera, CameraPose, Poses, RecordingPart, Scan, Scene, View
from executor.render import Viewpoint
from executor.stream.pose_codec import POSE_BYTES, unpack
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from executor.world.sensing.sensors import Sensors
from executor.world.simulation.streams import Streams

if TYPE_CHECKING:
    from executor.child_messages import Frame

decode = msgspec.msgpack.Decoder(Scene | Poses | Scan | Camera | View).decode


class PlainRenderer:
    """Counts the requests, and draws grey."""

    name = "plain"

    def __init__(self) -> None:
        self.drawn: list[tuple[Viewpoint, int, int]] = []

    def load(self, scene: Scene) -> None:
        self.scene = scene

    def draw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int, *, smooth: bool = True
    ) -> NDArray[np.uint8]:
        self.drawn.append((view, width, height))
        return np.full((height, width, 3), 128, np.uint8)

    def redraw(
        self, poses: NDArray[np.float32], view: Viewpoint, width: int, height: int
    ) -> NDArray[np.uint8]:
        return self.draw(poses, view, width, height)

    def close(self) -> None:
        self.drawn.clear()


class Watched:
    """A world with streams, whose frames are collected."""

    def __init__(self) -> None:
        self.world = BulletWorld(load_builtin("person_in_green"))
        self.renderer = PlainRenderer()
        renderer: Any = self.renderer  # it draws; nothing asks it for depth
        self.sensors = Sensors(self.world, lambda: renderer)
        self.sent: list[Frame] = []
        # By this clock drawing takes no time: on a busy machine a slow picture would delay others.
        self.streams = Streams(self.world, self.sensors, self.sent.append, clock=lambda: 0.0)
        self.now_s = 0.0

    def run(self, seconds: float, hz: float = 60) -> list[Any]:
        """Passes simulated and real time alike; returns the frames that were sent."""
        first = len(self.sent)
        for _ in range(round(seconds * hz)):
            self.now_s += 1 / hz
            self.world.step(round(240 / hz))
            self.sensors.changed()
            self.streams.send_due(self.now_s)
        return self.frames(first)

    def stand(self, seconds: float) -> list[Any]:
        """Passes only real time."""
        first = len(self.sent)
        for _ in range(round(seconds * 60)):
            self.now_s += 1 / 60
            self.streams.send_due(self.now_s)
        return self.frames(first)

    def frames(self, first: int = 0) -> list[Any]:
        return [decode(message.data) for message in self.sent[first:]]


@pytest.fixture
def watched() -> Iterator[Watched]:
    made = Watched()
    yield made
    made.world.close()


@pytest.fixture
def two_eyed() -> Iterator[Watched]:
    """A world whose robot has a second camera."""
    made = Watched()
    robot: Any = made.world.robots[0]
    front = robot.config.cameras[0]
    cameras = (front, front.model_copy(update={"name": "rear"}))
    robot.config = dataclasses.replace(robot.config, cameras=cameras)
    yield made
    made.world.close()


def test_without_subscribers_nothing_is_measured(watched: Watched) -> None:
    assert watched.run(0.5) == []
    assert watched.renderer.drawn == []


def test_the_scene_comes_first_then_only_changed_poses(watched: Watched) -> None:
    watched.streams.subscribe("a", "poses", max_hz=30)
    frames = watched.run(1.0)
    assert isinstance(frames[0], Scene)
    scene = watched.sent[0]
    assert (scene.client, scene.stream, scene.keep) == ("a", "scene", True)
    everything = np.frombuffer(frames[1].ids, "<u2")
    assert len(everything) == len(frames[0].objects)
    moving = {o.id for o in frames[0].objects if o.kind in ("actor", "robot")}
    for frame in frames[2:]:
        assert set(np.frombuffer(frame.ids, "<u2").tolist()) <= moving
        assert len(frame.poses) == len(frame.ids) // 2 * POSE_BYTES
    assert 28 <= len(frames) - 1 <= 32


def test_applying_all_poses_gives_the_world(watched: Watched) -> None:
    watched.streams.subscribe("a", "poses", max_hz=60)
    watched.world.robots[0].command(0.3, 0.5)
    frames = watched.run(0.5)
    seen = np.array([o.pose for o in frames[0].objects], np.float32)
    for frame in frames[1:]:
        records = [frame.poses[at : at + POSE_BYTES] for at in range(0, len(frame.poses), POSE_BYTES)]
        seen[np.frombuffer(frame.ids, "<u2")] = [unpack(record) for record in records]
    np.testing.assert_allclose(seen, watched.world.poses(), atol=2e-4)


def test_a_world_that_stands_sends_nothing_twice(watched: Watched) -> None:
    for stream in ("poses", "scan", "camera", "view"):
        watched.streams.subscribe("a", stream)
    first = watched.stand(0.2)
    assert {type(frame) for frame in first} == set(FRAMES) - {RecordingPart}
    assert watched.stand(1.0) == []


def test_sensors_give_no_more_than_their_rate(watched: Watched) -> None:
    watched.streams.subscribe("a", "scan", max_hz=30)
    watched.streams.subscribe("a", "camera", max_hz=30)
    frames = watched.run(2.0)
    assert 19 <= sum(isinstance(frame, Scan) for frame in frames) <= 21
    assert 29 <= sum(isinstance(frame, Camera) for frame in frames) <= 31


def test_a_client_gets_at_most_its_requested_rate(watched: Watched) -> None:
    watched.streams.subscribe("slow", "poses", max_hz=5)
    watched.streams.subscribe("slow", "camera", max_hz=4)
    frames = watched.run(2.0)
    assert 9 <= sum(isinstance(frame, Poses) for frame in frames) <= 12
    assert 7 <= sum(isinstance(frame, Camera) for frame in frames) <= 9


def test_two_clients_share_one_picture(watched: Watched) -> None:
    watched.streams.subscribe("a", "camera")
    watched.streams.subscribe("b", "camera")
    frames = watched.stand(0.1)
    assert len(frames) == 2
    assert len(watched.renderer.drawn) == 1


def test_a_camera_is_drawn_in_the_requested_width(watched: Watched) -> None:
    watched.streams.subscribe("a", "camera", width=320)
    [frame] = watched.stand(0.1)
    assert (frame.width, frame.height) == (320, 240)
    assert simplejpeg.decode_jpeg(frame.jpeg).shape == (240, 320, 3)


def test_each_camera_is_sent_on_a_lane_of_its_own(two_eyed: Watched) -> None:
    two_eyed.streams.subscribe("a", "camera")
    two_eyed.streams.subscribe("a", "camera", sensor="rear", width=160, max_hz=5)
    two_eyed.streams.subscribe("a", "camera", sensor="none such")
    frames = two_eyed.run(1.0)
    assert {frame.sensor for frame in frames} == {"camera", "rear"}
    assert {(message.stream, decode(message.data).sensor) for message in two_eyed.sent} == {
        ("camera", "camera"),
        ("camera/rear", "rear"),
    }
    rear = [frame for frame in frames if frame.sensor == "rear"]
    assert {frame.width for frame in rear} == {160}
    assert 4 <= len(rear) <= 6
    two_eyed.streams.unsubscribe("a", "camera")
    assert {frame.sensor for frame in two_eyed.run(0.5)} == {"rear"}


def test_a_view_follows_its_client(watched: Watched) -> None:
    pose = CameraPose((1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
    watched.streams.subscribe("a", "view", width=640, camera_pose=pose)
    [frame] = watched.stand(0.1)
    assert (frame.width, frame.height) == (640, 360)
    assert watched.renderer.drawn[-1][0].eye == (1.0, 2.0, 3.0)
    watched.streams.subscribe("a", "view", camera_pose=CameraPose((4.0, 0.0, 1.0), (0.0, 0.0, 0.0)))
    assert len(watched.stand(0.2)) == 1
    assert watched.renderer.drawn[-1][0].eye == (4.0, 0.0, 1.0)


def test_a_late_joiner_gets_all(watched: Watched) -> None:
    watched.streams.subscribe("a", "poses")
    watched.run(0.5)
    first = len(watched.sent)
    watched.streams.subscribe("late", "poses")
    watched.stand(0.1)
    mine = [decode(m.data) for m in watched.sent[first:] if m.client == "late"]
    assert isinstance(mine[0], Scene)
    assert len(mine[1].ids) // 2 == len(mine[0].objects)


def test_unsubscribing_ends_a_stream(watched: Watched) -> None:
    watched.streams.subscribe("a", "poses")
    watched.run(0.1)
    watched.streams.unsubscribe("a", "poses")
    watched.streams.unsubscribe("a", "poses")
    assert watched.run(0.2) == []


def test_a_new_scene_is_sent_to_all(watched: Watched) -> None:
    watched.streams.subscribe("a", "poses")
    watched.run(0.2)
    watched.world.reset()
    watched.streams.scene_changed()
    frames = watched.stand(0.1)
    assert [type(frame) for frame in frames] == [Scene, Poses]


def test_scans_have_the_measurements_of_the_lidar(watched: Watched) -> None:
    watched.streams.subscribe("a", "scan")
    [scan] = watched.stand(0.1)
    robot = watched.world.robots[0]
    expected = robot.scan(robot.config.lidars[0])
    np.testing.assert_array_equal(np.frombuffer(scan.ranges, "<f4"), expected.ranges)
    assert scan.pose == pytest.approx(expected.pose)


def test_a_slow_client_gets_smaller_pictures_and_others_do_not(watched: Watched) -> None:
    for client in ("slow", "fast"):
        watched.streams.subscribe(client, "camera")
    for _ in range(10):
        watched.streams.pace("slow", 1.0)
    first = len(watched.sent)
    watched.run(2.0)
    frames: dict[str, list[Camera]] = {"slow": [], "fast": []}
    for message in watched.sent[first:]:
        frames[message.client].append(decode(message.data))
    assert {frame.width for frame in frames["fast"]} == {640}
    assert {frame.width for frame in frames["slow"]} == {160}
    assert len(frames["slow"]) < 0.4 * len(frames["fast"])
    watched.streams.pace("nobody", 1.0)


def test_a_returning_client_starts_with_the_best_level(watched: Watched) -> None:
    watched.streams.subscribe("a", "camera")
    for _ in range(10):
        watched.streams.pace("a", 1.0)
    watched.streams.unsubscribe("a", "camera")
    watched.streams.subscribe("a", "camera")
    [frame] = watched.stand(0.1)
    assert frame.width == 640


def test_slow_pictures_leave_time_for_the_world(watched: Watched) -> None:
    clock = [0.0]

    def draw(*_: object, **__: object) -> NDArray[np.uint8]:
        clock[0] += 0.2
        return np.zeros((9, 16, 3), np.uint8)

    watched.renderer.draw = draw  # type: ignore[method-assign]
    watched.streams = Streams(watched.world, watched.sensors, watched.sent.append, clock=lambda: clock[0])
    watched.streams.subscribe("a", "view")
    watched.streams.subscribe("a", "poses")
    frames = watched.run(2.0)
    # A fifth of a second for the picture, a quarter of that for everything else.
    assert 7 <= sum(isinstance(frame, View) for frame in frames) <= 9
    assert sum(isinstance(frame, Poses) for frame in frames) > 50
