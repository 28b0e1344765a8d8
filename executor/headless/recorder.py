"""Records a run in lock-step: the events and frames that a session would send, by simulated time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import messages
from executor.application.report import Reporter
from executor.child_messages import Log, event_of, name_of
from executor.world.simulation.streams import Streams

if TYPE_CHECKING:
    from executor.application.report import Report
    from executor.child_messages import Frame
    from executor.headless.recording import Recording
    from executor.messages import StreamName
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors
    from tree_gardener import Status, TickError, Tree

STREAMS_HZ: Final[dict[StreamName, float]] = {"poses": 30.0, "scan": 30.0}


class RunRecorder:
    """Writes one run into a recording.

    Args:
        recording: the open recording.
        world: the simulated world.
        sensors: the sensors of the world.
        tree: the tree; each of its ticks is written from now on.
    """

    def __init__(self, recording: Recording, world: World, sensors: Sensors, tree: Tree) -> None:
        self._recording = recording
        self._world = world
        self._tree = tree
        self._streams = Streams(world, sensors, self._write_frame, clock=self._now_s)
        for stream, rate_hz in STREAMS_HZ.items():
            self._streams.subscribe(None, stream, max_hz=rate_hz)
        self._reporter = Reporter(self._write_event, self._now_s, clock=self._now_s)
        self._reporter.tree(tree)
        tree.observe(self._reporter.ticked)

    def look(self) -> None:
        """Writes the frames that are due."""
        self._streams.send_due(self._now_s())

    def raised(self, error: TickError) -> None:
        """Writes an exception of an action."""
        self._reporter.raised(error)

    def finished(self, status: Status | None) -> None:
        """Writes the end of the tree."""
        self._reporter.finished(status, "root_finished", "")

    def _now_s(self) -> float:
        return self._world.time_s

    def _write_frame(self, frame: Frame) -> None:
        self._recording.packed_frame(frame.data)

    def _write_event(self, message: Report) -> None:
        name = name_of(message)
        if isinstance(message, Log):
            place = message.node_id, message.node_path
            data: object = messages.Log("action", message.level, message.text, *place, time=self._now_s())
        else:
            data = event_of(message, messages.EVENTS[name])
        self._recording.event(
            {"command": name, "t": self._now_s(), "tick": self._tree.tick_number, "data": data}
        )
