"""Liveness of a child process, from its beats and from samples of its state. Time is an argument.

Only time in which the child could have worked counts: not the delay of the manager itself, and little of the
time in which the child waited for a processor. So a slow machine alone never looks like a hang.
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
"""Share of the time that counts: a thread that computes at least this long is at work."""
MOST_FORGIVEN: Final = 0.75
"""Limit of the share of a sample that waits for a processor excuse: a busy machine must not hide a hang."""
FROZEN_S: Final = 1.0
STARTING: Final = "starting"
STOPPED: Final = "T"
TRACED: Final = "t"
ON_DISK: Final = "D"


class Vitals:
    """Liveness of one child.

    Attributes:
        silent_s: since the last message.
        stuck_s: since its main thread completed its loop.
        idle_s: in which it neither completed its loop nor computed.
        deaf_s: since it received, or published, simulated time; counted by `watch`.
        task: what it loads, or another long task; "" while its main thread should run its loop.
        place: where its main thread is, if it has not completed its loop for a moment.
        state: the kernel's letter.
    """

    def __init__(self, now_s: float) -> None:
        self.silent_s = self.stuck_s = self.idle_s = self.deaf_s = 0.0
        self.task = STARTING
        self.place = Place()
        self.state = ""
        self.clocks = 0
        self.has_beaten = False
        self._turns = -1
        self._looked_s = now_s

    def heard(self, *, from_main: bool) -> None:
        """Notes a message; `from_main` if only the main thread sends such."""
        self.silent_s = 0.0
        if from_main:
            self.stuck_s = self.idle_s = 0.0

    def beat(self, message: Beat) -> None:
        """Notes a beat."""
        self.has_beaten = True
        self.task = message.task
        self.place = message.place or Place()
        if message.turns != self._turns:
            self._turns = message.turns
            self.stuck_s = self.idle_s = 0.0
        if message.clocks != self.clocks:
            self.clocks, self.deaf_s = message.clocks, 0.0

    def look(self, seen: ChildLooked, now_s: float) -> float:
        """Takes a sample of the process; returns the seconds that count since the last one."""
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
        """Whether no thread of it sends anything."""
        return self.silent_s >= FROZEN_S or self.state == STOPPED

    @property
    def is_in_action(self) -> bool:
        """Whether its main thread was last seen in the user's code."""
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
        """Whether it must be ended."""
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
        """Whether it works normally."""
        return self.silent_s < FROZEN_S and self.stuck_s < FAULT_AFTER_S / 2
