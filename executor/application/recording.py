"""Sends the events of the tree to the recorder of the session."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from executor.application.preview import preview
from executor.recorder.event_messages import input_fields
from executor.recorder.link import Record, RecorderLink, Until
from executor.recorder.tree_recorder import TreeRecorder
from executor.recorder.writer import nanoseconds

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from tree_gardener import Tree
    from tree_gardener.profiling import NodeTime

__all__ = ["ApplicationRecorder"]

GOODBYE_S: Final = 0.2
RESET_S: Final = 1.0
MOST_TICKS: Final = 50
"""So many ticks are written at once, at most: a tree that ticks fast does not wait for all of a batch."""


class _Later(NamedTuple):
    """A run that begins once the time is less than at its reset, or after a while of real time."""

    run: str
    reset_at_s: float
    until_s: float


class ApplicationRecorder:
    """Records a tree: its nodes, each tick, and each write to the blackboard with its writer.

    Args:
        tree: the tree.
        now: returns the simulated time in s.
        address: the address of the recorder; "" if nothing is recorded.
    """

    def __init__(
        self,
        tree: Tree,
        now: Callable[[], float],
        address: str,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._tree = tree
        self._now = now
        self._generation = 0
        self._recorder: TreeRecorder | None = None
        self._clock = clock
        self._link = RecorderLink(address, self._restate, clock, self._gathered)
        self._later: _Later | None = None

    def begin(self, run: str, *, resets: bool = False) -> None:
        """Begins the recording of a run; after a reset as soon as the time has gone back here too."""
        if resets:
            self._later = _Later(run, self._now(), self._clock() + RESET_S)
        else:
            self._write_ticks()  # they belong to the run before
            self._link.begin(run)

    def did(self, command: str, data: Any, tick: int, hook: int) -> None:
        """Records what a person did, at the `hook`-th stop of a tick, or between two ticks (-1)."""
        self._write_ticks()
        self._send("/bt/input", "Input", input_fields(self._now(), command, data, tick, hook))

    def changed(self) -> None:
        """Records the tree again, as the next generation, after a port has got another text."""
        if self._recorder is not None and self._link.is_recording:
            self._restate()

    def follow(self, tree: Tree) -> None:
        """Records another tree from now on, as the next generation."""
        self._write_ticks()
        self._tree, self._recorder = tree, None
        if self._link.is_recording:
            self._restate()

    def leave_out(self, duration_s: float) -> None:
        """Leaves out a hold of the debugger from the duration of the tick that is made."""
        if self._recorder is not None:
            self._recorder.leave_out(duration_s)

    def profiled(self, ticks: int, times: Sequence[NodeTime]) -> None:
        """Records the times of nodes in the ticks since the last call."""
        if self._recorder is not None:
            self._recorder.profiled(ticks, times)

    def pump(self) -> None:
        """Sends the waiting messages. Called many times in a second."""
        recorder = self._recorder
        if recorder is not None and (recorder.waiting >= MOST_TICKS or not self._link.is_recording):
            recorder.flush()  # nobody takes them where there is no recorder
        later = self._later
        if later is not None and (self._now() < later.reset_at_s or self._clock() >= later.until_s):
            self._later = None
            self._link.begin(later.run)
        self._link.pump()

    def close(self) -> None:
        """Sends the last messages."""
        self._write_ticks()
        self._link.flush(GOODBYE_S)
        self._link.close()

    def _write_ticks(self) -> None:
        if self._recorder is not None:
            self._recorder.flush()

    def _gathered(self) -> Iterator[Until]:
        self._write_ticks()
        yield Until(self._now_ns())

    def _restate(self) -> None:
        self._generation += 1
        if self._recorder is None:
            self._recorder = TreeRecorder(self._tree, self._send, self._now_ns, _describe, self._generation)
        else:
            self._recorder.restate(self._generation)

    def _send(self, topic: str, name: str, fields: Mapping[str, Any]) -> None:
        self._link.send(Record(topic, name, dict(fields)))

    def _now_ns(self) -> int:
        return nanoseconds(self._now())


def _describe(value: Any) -> str:
    return str(preview(value)[0])
