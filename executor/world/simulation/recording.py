"""Sends the events of a world to the recorder of the session."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Protocol

import msgspec

from executor.messages import Camera
from executor.recorder.event_messages import input_fields
from executor.recorder.link import Dump, Heard, Record, RecorderLink, Until
from executor.recorder.thinning import Thinner, Verdict
from executor.recorder.writer import nanoseconds
from executor.world.simulation.pose_track import PoseTrack

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator

    from executor.child_messages import Frame
    from executor.ros.node import WorldNode
    from executor.world.interface import World

__all__ = ["WorldRecorder"]

KEYFRAME_S: Final = 5.0
_encode = msgspec.msgpack.Encoder().encode
_decode_camera = msgspec.msgpack.Decoder(Camera).decode


class Tap(Protocol):
    """Takes messages of topics, and pictures that are coded already."""

    def __call__(self, topic: str, message: Any, now_s: float) -> None:
        """Takes one message."""

    def jpeg(self, topic: str, jpeg: bytes, now_s: float, frame_id: str) -> None:
        """Takes one picture."""

    def flush(self) -> None:
        """Writes what was taken."""


class GraphTap(Protocol):
    """Takes messages of topics that others publish."""

    def is_due(self, now_s: float) -> bool:
        """Whether messages may have arrived."""

    def poll(self, now_s: float) -> None:
        """Takes the messages that have arrived; the time is real time in s."""

    def restart(self) -> None:
        """Begins again, with the latched messages."""

    def close(self) -> None:
        """Takes nothing more."""


class MakeGraphTap(Protocol):
    """Makes a tap of a graph."""

    def __call__(
        self,
        own: Collection[str],
        write: Callable[[str, str, bytes, float], None],
        note: Callable[[str], None],
    ) -> GraphTap:
        """Returns a new tap."""


class WorldRecorder:
    """Records scene, poses, topics, looked-at cameras and, every 5 s, the whole state of a world.

    Args:
        world: the simulated world.
        node: the world's ROS node; each message of its topics is recorded.
        make_tap: makes the tap of the topics; its argument writes topic, type, time in s and message.
        address: the address of the recorder; "" if nothing is recorded.
    """

    def __init__(
        self,
        world: World,
        node: WorldNode,
        make_tap: Callable[[Callable[[str, str, float, bytes], None]], Tap],
        address: str,
    ) -> None:
        self._world = world
        self._node = node
        self._link = RecorderLink(address, self._restate, gather=self._gathered)
        self._thinner = Thinner()
        self._tap = make_tap(self._topic)
        self._make_graph_tap: MakeGraphTap | None = None
        self._graph_tap: GraphTap | None = None
        self._poses = PoseTrack()
        self._dump_s = 0.0
        self._real_s = 0.0
        self._polled_s = 0.0

    def join(self, make_graph_tap: MakeGraphTap) -> None:
        """Records the topics that others publish too, once a run has begun.

        The arguments of the function are the names of the topics that are recorded already, a function that
        writes topic, type, message and the share of the time since the last look that has passed after it,
        and one that notes a sentence.
        """
        self._make_graph_tap = make_graph_tap

    def begin(self, run: str) -> None:
        """Begins the recording of a run."""
        self._tap.flush()  # it belongs to the run before
        self._thinner = Thinner()
        self._node.tap(self._tap, samples=True)
        if self._graph_tap is not None:
            self._graph_tap.restart()
        self._link.begin(run)

    def look(self, real_s: float) -> None:
        """Sends all that is due."""
        self._real_s = real_s
        self._link.pump()
        if not self._link.is_recording:
            self._tap.flush()  # nobody takes it
            return
        now_s = self._world.time_s
        if now_s >= self._poses.next_s:
            self._poses.note(now_s, self._world.read_poses())
        if self._graph_tap is None and self._make_graph_tap is not None:
            self._graph_tap = self._make_graph_tap(self._node.topics, self._foreign, self._note)
        if self._graph_tap is not None and self._graph_tap.is_due(real_s):
            self._poll_graph()
        if now_s >= self._dump_s:
            self._dump_s = now_s + KEYFRAME_S
            step = round(now_s / self._world.step_s)
            self._link.send(Dump(nanoseconds(now_s), step, self._world.dump()))

    def picture(self, frame: Frame) -> None:
        """Records a picture of a camera that a client subscribes to."""
        if self._link.is_recording and frame.stream.partition("/")[0] == "camera":
            camera = _decode_camera(frame.data)
            self._tap.jpeg(f"/world/camera/{camera.sensor}", camera.jpeg, camera.t, camera.sensor)

    def did(self, command: str, data: Any) -> None:
        """Records what a person did to the world."""
        self._link.send(Record("/bt/input", "Input", input_fields(self._world.time_s, command, data, None)))

    def flush(self, patience_s: float) -> None:
        """Sends all that waits, for at most this time."""
        self._link.flush(patience_s)

    def close(self) -> None:
        """Ends the tap of the graph."""
        if self._graph_tap is not None:
            self._graph_tap.close()

    def _restate(self) -> None:
        now_s = self._dump_s = self._world.time_s
        scene = {"stamp": nanoseconds(now_s), "data": _encode(self._world.scene)}
        self._link.send(Record("/world/scene", "Scene", scene))
        self._poses = PoseTrack()  # time may have gone back
        self._poses.note(now_s, self._world.read_poses())

    def _gathered(self) -> Iterator[Record | Until]:
        self._tap.flush()
        self._poll_graph()
        for time_s, frame in self._poses.take():
            yield Record("/world/poses", "Poses", {"stamp": nanoseconds(time_s), "data": frame})
        yield Until(nanoseconds(self._world.time_s))

    def _poll_graph(self) -> None:
        if self._graph_tap is not None:
            self._graph_tap.poll(self._real_s)
            self._polled_s = self._world.time_s

    def _topic(self, topic: str, kind: str, now_s: float, data: bytes) -> None:
        is_picture = topic.endswith("/compressed")
        verdict = Verdict(is_kept=True) if is_picture else self._thinner.take(topic, now_s, len(data))
        if verdict.note:
            self._note(verdict.note)
        if verdict.is_kept:
            self._link.send(Heard(topic, kind, nanoseconds(now_s), data))

    def _foreign(self, topic: str, kind: str, data: bytes, late: float) -> None:
        now_s = self._world.time_s
        self._topic(topic, kind, now_s - late * max(0.0, now_s - self._polled_s), data)

    def _note(self, text: str) -> None:
        fields = {"source": "world", "level": "warning", "text": text, "uid": 0}
        self._link.send(Record("/bt/log", "Log", {"stamp": nanoseconds(self._world.time_s), **fields}))
