"""Records a run in lock-step: tree, world and topics, by simulated time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.application.preview import preview
from executor.recorder.thinning import Thinner
from executor.recorder.tree_recorder import TreeRecorder
from executor.recorder.writer import nanoseconds
from executor.ros.tap import TopicTap
from executor.world.simulation.streams import Streams

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from executor.child_messages import Frame, Log
    from executor.headless.recording import Recording
    from executor.ros.node import WorldNode
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors
    from tree_gardener import Status, TickError, Tree
    from tree_gardener.profiling import NodeTime

POSES_HZ: Final = 30.0
KEYFRAME_S: Final = 5.0
FLUSH_S: Final = 1.0


class RunRecorder:
    """Writes one run into a recording. Once in a simulated second, all is written to disk.

    Args:
        recording: the open recording.
        world: the simulated world.
        sensors: the sensors of the world.
        node: the world's ROS node; each message of its topics is written.
        tree: the tree; each of its ticks is written from now on.
    """

    def __init__(
        self, recording: Recording, world: World, sensors: Sensors, node: WorldNode, tree: Tree
    ) -> None:
        self._recording = recording
        self._writer = recording.writer
        self._world = world
        self._keyframe_s = self._flush_s = 0.0
        self._thinner = Thinner()
        self._streams = Streams(world, sensors, self._write_frame, clock=self._now_s)
        self._streams.subscribe(None, "poses", max_hz=POSES_HZ)
        self._tree = TreeRecorder(tree, self._record, self._now_ns, _describe)
        tree.observe(lambda _: self._tree.flush())  # simulated time stands in a tick
        node.tap(TopicTap(self._topic))

    def look(self) -> None:
        """Writes all that is due."""
        now_s = self._now_s()
        self._streams.send_due(now_s)
        if now_s >= self._keyframe_s:
            self._keyframe_s = now_s + KEYFRAME_S
            self._tree.keyframe(round(now_s / self._world.step_s), self._world.dump())
        for robot, collision in self._world.take_collisions():
            self._tree.says("warning", collision.told(robot), source="world")
        if now_s >= self._flush_s:
            self._flush_s = now_s + FLUSH_S
            self._guarded(self._writer.flush)

    def end(self) -> None:
        """Writes where everything is at the end, also between two frames."""
        self._streams.send_due(self._now_s() + 1.0 / POSES_HZ)

    def raised(self, error: TickError) -> None:
        """Writes an exception of an action."""
        self._tree.raised(error)

    def profiled(self, ticks: int, times: Sequence[NodeTime]) -> None:
        """Writes the times of nodes in the ticks since the last call."""
        self._tree.profiled(ticks, times)

    def says(self, level: str, text: str) -> None:
        """Writes a line of the run."""
        self._tree.says(level, text)

    def printed(self, line: Log) -> None:
        """Writes a line that an action printed."""
        self._tree.says(line.level, line.text, line.node_path, source="action")

    def finished(self, status: Status | None) -> None:
        """Writes the end of the tree."""
        self._tree.says("info", f"The tree ended with {status.name if status else 'FAILURE'}.")

    def _now_s(self) -> float:
        return self._world.time_s

    def _now_ns(self) -> int:
        return nanoseconds(self._world.time_s)

    def _write_frame(self, frame: Frame) -> None:
        if frame.stream == "scene":
            self._guarded(lambda: self._writer.scene(self._now_ns(), frame.data))
        else:
            self._record("/world/poses", "Poses", {"stamp": self._now_ns(), "data": frame.data})

    def _record(self, topic: str, name: str, fields: Mapping[str, Any]) -> None:
        self._guarded(lambda: self._writer.record(topic, name, fields))

    def _topic(self, topic: str, kind: str, now_s: float, data: bytes) -> None:
        verdict = self._thinner.take(topic, now_s, len(data))
        if verdict.note:
            self._tree.says("warning", verdict.note)
        if verdict.is_kept:
            self._guarded(lambda: self._writer.write(topic, kind, nanoseconds(now_s), data))

    def _guarded(self, write: Callable[[], None]) -> None:
        """Writes; if that fails, the recording stops there, and the run continues."""
        if self._recording.is_stopped:
            return
        try:
            write()
        except OSError as error:
            self._recording.stop(error)


def _describe(value: Any) -> str:
    return str(preview(value)[0])
