"""Follows a run in lock-step and writes down what its session would have told: by simulated time alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor.application.report import Reporter
from executor.session.child_events import APPLICATION_EVENTS
from executor.world.simulation.streams import Streams

if TYPE_CHECKING:
    from executor.headless.recording import Recording
    from executor.messages import StreamName
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors
    from tree_gardener import Status, TickError, Tree

STREAMS_HZ: Final[dict[StreamName, float]] = {"poses": 30.0, "scan": 30.0}


class RunRecorder:
    """Writes one run into a recording.

    Args:
        recording: open.
        world: that is simulated.
        sensors: of it.
        tree: that is ticked; each of its ticks is written from now on.
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
        """Writes what is due of the world."""
        self._streams.send_due(self._now_s())

    def raised(self, error: TickError) -> None:
        """An action raised."""
        self._reporter.raised(error)

    def finished(self, status: Status | None) -> None:
        """The run ended by itself."""
        self._reporter.finished(status, "finished", "")

    def _now_s(self) -> float:
        return self._world.time_s

    def _write_frame(self, message: dict[str, Any]) -> None:
        self._recording.packed_frame(message["data"])

    def _write_event(self, message: dict[str, Any]) -> None:
        name = message["type"]
        data = msgspec.convert(message, APPLICATION_EVENTS[name], strict=False)
        self._recording.event(
            {"command": name, "t": self._now_s(), "tick": self._tree.tick_number, "data": data}
        )
