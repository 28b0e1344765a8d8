"""How a child process does, from its beats and from looks at it from outside. Time is an argument.

What counts is time in which the child could have done something: not what passed while the manager itself was
late, and little of what the child waited for a processor. So on a machine where all is slow nothing hangs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from executor.session.events import ChildLooked

__all__ = ["END_AFTER_S", "FAULT_AFTER_S", "Vitals"]

FAULT_AFTER_S: Final = 2.0
END_AFTER_S: Final = 8.0
LOADING_S: Final = 60.0
LONGEST_GAP_S: Final = 0.5
BUSY_SHARE: Final = 0.1
"""Of the time that counts: who computes at least so much of it is at work."""
MOST_FORGIVEN: Final = 0.75
"""Of the time in which it waits for a processor: what hangs must be found on a busy machine, too."""
FROZEN_S: Final = 1.0
STARTING: Final = "starting"
STOPPED: Final = "T"
TRACED: Final = "t"
ON_DISK: Final = "D"


class Vitals:
    """What is known of one child.

    Attributes:
        silent_s: since the last message.
        stuck_s: since its main thread came round.
        idle_s: in which it neither came round nor computed.
        deaf_s: since it heard, or told, what simulated time it is; counted by `watch`.
        task: what it loads, or does else that may take long; "" while its main thread should come round.
        place: where its main thread is, once it has been away for a moment.
        state: Linux's letter.
    """

    def __init__(self, now_s: float) -> None:
        self.silent_s = self.stuck_s = self.idle_s = self.deaf_s = 0.0
        self.task = STARTING
        self.place: dict[str, Any] = {}
        self.state = ""
        self.clocks = 0
        self.has_beaten = False
        self._turns = -1
        self._looked_s = now_s

    def heard(self, *, from_main: bool) -> None:
        """A message came; some are sent by the main thread alone."""
        self.silent_s = 0.0
        if from_main:
            self.stuck_s = self.idle_s = 0.0

    def beat(self, message: dict[str, Any]) -> None:
        """A beat came."""
        self.has_beaten = True
        self.task = str(message.get("task", ""))
        place = message.get("place")
        self.place = place if isinstance(place, dict) else {}
        if message.get("turns") != self._turns:
            self._turns = message.get("turns", 0)
            self.stuck_s = self.idle_s = 0.0
        if (clocks := message.get("clocks", 0)) != self.clocks:
            self.clocks, self.deaf_s = clocks, 0.0

    def look(self, seen: ChildLooked, now_s: float) -> float:
        """Takes a look from outside; returns the seconds that count since the last one."""
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
        """Whether nothing at all is heard of it."""
        return self.silent_s >= FROZEN_S or self.state == STOPPED

    @property
    def is_in_action(self) -> bool:
        """Whether its main thread was last seen in the user's code."""
        return bool(self.place.get("file") or self.place.get("node_path"))

    @property
    def hangs(self) -> bool:
        """Whether it has done nothing for so long that people should know."""
        if self.task == STARTING:  # no code of the user: large libraries may hold the interpreter lock
            return self.silent_s >= FROZEN_S and self.idle_s >= FAULT_AFTER_S
        if self.silent_s >= FROZEN_S:
            return self.silent_s >= FAULT_AFTER_S  # it is more than its main thread
        return self.stuck_s >= FAULT_AFTER_S and (not self.task or self.is_in_action)

    @property
    def is_lost(self) -> bool:
        """Whether it is to be ended."""
        if self.task:
            # What computes is loading; what sleeps waits for something that does not come.
            return self.idle_s >= END_AFTER_S or self.stuck_s >= LOADING_S
        if self.silent_s >= END_AFTER_S:
            return True
        # A tick may be slow only; Pause and Stop break it off.
        return self.stuck_s >= END_AFTER_S and not self.is_in_action

    @property
    def is_well(self) -> bool:
        """Whether it does what it should."""
        return self.silent_s < FROZEN_S and self.stuck_s < FAULT_AFTER_S / 2
