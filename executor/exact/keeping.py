"""Decides when an exact run makes a snapshot of itself, and says so to the session."""

from __future__ import annotations

import os
import socket
import time
from typing import TYPE_CHECKING, Any, Final, Protocol

from executor.child_messages import NoSnapshots, SnapshotTaken
from executor.exact.foreign import Foreign
from executor.exact.snapshots import Snapshots, Woken
from executor.supervision.handover import HANDOVER_VARIABLE

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Keeping"]

SPACING_S: Final = 0.5
DRAWING_SPACING_S: Final = 1.5
RETRY_S: Final = 0.02
WANTED_TRIES: Final = 40
WANTED_RETRY_S: Final = 0.005
BUSY: Final = "another thread of its process was busy"


class Loop(Protocol):
    """The loop of the run, as it is used here."""

    @property
    def ticks(self) -> int:
        """The number of ticks that were begun."""

    @property
    def time_s(self) -> float:
        """The simulated time in s."""

    @property
    def is_at_tick(self) -> bool:
        """Whether nothing was simulated since the last tick."""


class Keeping:
    """Makes snapshots at ticks, each after so much work that making it again takes a moment.

    Args:
        send: sends a message to the session.
        clock: returns the processor time of this thread in s.
    """

    def __init__(self, send: Callable[[Any], None], clock: Callable[[], float] = time.thread_time) -> None:
        fd = int(os.environ.pop(HANDOVER_VARIABLE, "-1"))
        self._snapshots = Snapshots(socket.socket(fileno=fd)) if fd >= 0 else None
        if fd >= 0:
            os.set_inheritable(fd, False)  # noqa: FBT003 - positional only
        self._send = send
        self._clock = clock
        self._foreign: Foreign | None = None
        self._begun_s = self._last_s = clock()
        self._last_ticks = -1
        self._number = 0
        self._reason = ""
        self.is_on = False
        self.inputs = self.resets = 0
        """What has entered the run."""

    def begin(self) -> None:
        """Notes what the process has before it loads the code of users."""
        self._foreign = Foreign()
        self._begun_s = self._last_s = self._clock()

    def is_due(self, loop: Loop, *, draws: bool) -> bool:
        """Returns whether a snapshot should be made now."""
        if not self.is_on or self._snapshots is None or loop.ticks == self._last_ticks or not loop.is_at_tick:
            return False
        spacing_s = DRAWING_SPACING_S if draws else SPACING_S
        return self._last_ticks < 0 or self._clock() - self._last_s >= spacing_s

    def refusal(self, renderer: str) -> str:
        """Returns why the process cannot be copied now, as the end of a sentence; "" if it can."""
        assert self._foreign is not None  # noqa: S101 - `begin` comes first
        return self._foreign.refusal(renderer)

    def take(self, loop: Loop, renderer: str, *, is_wanted: bool = False) -> Woken | None:
        """Makes a snapshot, or says why not; returns something only in a copy that was woken."""
        assert self._foreign is not None  # noqa: S101 - `begin` comes first
        cost_s = self._clock() - self._begun_s
        reason = self._foreign.refusal(renderer) if self._snapshots is not None else "it has no manager"
        if not reason:
            self._number += 1
            assert self._snapshots is not None  # noqa: S101 - as above
            made = self._snapshots.take(self._number)
            tries = WANTED_TRIES if is_wanted else 0
            while made is False and tries > 0:
                tries -= 1
                time.sleep(WANTED_RETRY_S)
                made = self._snapshots.take(self._number)
            if isinstance(made, Woken):
                self._foreign = Foreign()  # a copy has other threads
                self._last_s = self._clock()
                self._begun_s = self._last_s - cost_s
                self._last_ticks = loop.ticks
                return made
            reason = "" if made else BUSY
        if not reason:
            self._send(self._taken(loop, cost_s, draws=bool(renderer), is_wanted=is_wanted))
        elif is_wanted or (reason not in (BUSY, self._reason)):
            self._send(NoSnapshots(reason, is_wanted))
        if reason == BUSY:
            self._last_s += RETRY_S
            return None
        self._reason = reason
        self._last_ticks, self._last_s = loop.ticks, self._clock()
        return None

    def _taken(self, loop: Loop, cost_s: float, *, draws: bool, is_wanted: bool) -> SnapshotTaken:
        return SnapshotTaken(
            self._number,
            loop.time_s,
            loop.ticks,
            self.inputs,
            self.resets,
            is_at_tick=loop.is_at_tick,
            cost_s=cost_s,
            draws=draws,
            is_wanted=is_wanted,
        )
