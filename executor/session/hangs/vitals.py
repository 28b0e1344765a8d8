"""Tracks whether a child process is alive, from its beats and from samples of its state. Time is an argument.

Only time in which the child could have worked is counted: delays of the manager are not, and of the time in
which the child waited for a processor only a small share is. So a slow machine alone never looks like a hang.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.child_messages import Place

if TYPE_CHECKING:
    from executor.child_messages import Beat
    from executor.session.events import ChildLooked

__all__ = ["END_AFTER_S", "FAULT_AFTER_S", "Vitals"]

FAULT_AFTER_S: Final = 2.0
END_AFTER_S: Final = 8.0
LOADING_S: Final = 60.0
LONGEST_GAP_S: Final = 0.5
BUSY_SHARE: Final = 0.1
"""Share of the counted time: a thread that computes for at least this share is active."""
MOST_FORGIVEN: Final = 0.75
"""The largest share of a sample that is not counted because the child waited for a processor.

So a busy machine cannot hide a hang.
"""
FROZEN_S: Final = 1.0
STARTING: Final = "starting"
STOPPED: Final = "T"
TRACED: Final = "t"
ON_DISK: Final = "D"


class Vitals:
    """The signs of life of one child.

    Attributes:
        silent_s: counted seconds since the last message.
        stuck_s: counted seconds since the main thread completed its loop.
        idle_s: counted seconds in which the main thread neither completed its loop nor computed.
        deaf_s: counted seconds since the child received or published simulated time; `watch` adds to them.
        task: the long task of the main thread, such as loading; "" while it should run its loop.
        place: the place of the main thread, if it has not completed its loop for a moment.
        state: the kernel's letter for the state of the process.
        beats: the number of beats that came.
        ticks: the number of ticks that an exact run had begun at the last beat.
    """

    def __init__(self, now_s: float) -> None:
        self.silent_s = self.stuck_s = self.idle_s = self.deaf_s = 0.0
        self.task = STARTING
        self.place = Place()
        self.state = ""
        self.clocks = self.ticks = self.beats = 0
        self._turns = -1
        self._looked_s = now_s

    def heard(self, *, from_main: bool) -> None:
        """Notes a message; `from_main` is set if only the main thread sends messages of this kind."""
        self.silent_s = 0.0
        if from_main:
            self.stuck_s = self.idle_s = 0.0

    def beat(self, message: Beat) -> None:
        """Notes a beat."""
        self.beats += 1
        self.ticks = message.ticks
        self.task = message.task
        self.place = message.place or Place()
        if message.turns != self._turns:
            self._turns = message.turns
            self.stuck_s = self.idle_s = 0.0
        if message.clocks != self.clocks:
            self.clocks, self.deaf_s = message.clocks, 0.0

    @property
    def has_beaten(self) -> bool:
        """Whether a beat came."""
        return self.beats > 0

    @property
    def turns(self) -> int:
        """The number of times that the main thread had completed its loop, at the last beat."""
        return self._turns

    def look(self, seen: ChildLooked, now_s: float) -> float:
        """Adds a sample of the process; returns the counted seconds since the last sample."""
        gap_s = min(max(0.0, now_s - self._looked_s), LONGEST_GAP_S)
        self._looked_s, self.state = now_s, seen.state
        forgiven_s = min(seen.waited_s, MOST_FORGIVEN * gap_s)
        is_held = seen.state == TRACED or (seen.state == ON_DISK and bool(self.task))
        counted_s = 0.0 if is_held else gap_s - forgiven_s
        self.silent_s += counted_s
        self.stuck_s += counted_s
        is_at_work = seen.ran_s >= BUSY_SHARE * counted_s
        if counted_s:
            self.idle_s = 0.0 if is_at_work else self.idle_s + counted_s
        return counted_s

    @property
    def is_frozen(self) -> bool:
        """Whether no thread of the child sends anything."""
        return self.silent_s >= FROZEN_S or self.state == STOPPED

    @property
    def is_in_action(self) -> bool:
        """Whether the main thread of the child was last seen in the user's code."""
        return bool(self.place.file or self.place.node_path)

    @property
    def hangs(self) -> bool:
        """Whether the child has been inactive for so long that users must be notified."""
        if self.task == STARTING:
            # No user code runs yet, and importing large libraries may hold the interpreter lock.
            return self.silent_s >= FROZEN_S and self.idle_s >= FAULT_AFTER_S
        if self.silent_s >= FROZEN_S:
            return self.silent_s >= FAULT_AFTER_S  # no thread runs, not only the main one
        return self.stuck_s >= FAULT_AFTER_S and (not self.task or self.is_in_action)

    @property
    def is_lost(self) -> bool:
        """Whether the child has been inactive for so long that it must be ended."""
        if self.task:
            # A child that uses the processor is still loading. One that is idle waits for an event that never
            # comes.
            return self.idle_s >= END_AFTER_S or self.stuck_s >= LOADING_S
        if self.silent_s >= END_AFTER_S:
            return True
        # A tick may only be slow; Pause and Stop interrupt it.
        return self.stuck_s >= END_AFTER_S and not self.is_in_action

    @property
    def is_well(self) -> bool:
        """Whether the child works normally."""
        return self.silent_s < FROZEN_S and self.stuck_s < FAULT_AFTER_S / 2
