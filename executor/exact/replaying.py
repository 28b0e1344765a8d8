"""Makes a run again: the inputs of the first time enter at the same places.

Nothing waits for real time. Each tick has a fingerprint, so a run that has a source which is not repeated (a
clock of the wall, a thread, the network) is found at the tick at which it differs.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final, Protocol

from executor.child_messages import Differs, GoingBack, Reset, WentBack, decode_to_exact
from executor.replay_messages import FINGERPRINT_BYTES
from executor.run_inputs import input_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.child_messages import ToExact
    from executor.replay_messages import Input, Replay

__all__ = ["NotThereError", "Replaying"]

TOLD_S: Final = 0.2
EPSILON_S: Final = 1e-6
NOT_REPEATED: Final = "the clock of the wall, random numbers without a seed, threads, and the network"


class NotThereError(Exception):
    """The run cannot be made again up to the moment."""


class Loop(Protocol):
    """The loop of the world, as it is used here."""

    @property
    def ticks(self) -> int:
        """The number of ticks that were begun."""

    @property
    def step_number(self) -> int:
        """The present step of the world."""

    @property
    def time_s(self) -> float:
        """The simulated time in s."""

    @property
    def tick_hz(self) -> float:
        """The ticks in a second of simulated time."""

    def run_to_tick(self, between: Callable[[], None]) -> None:
        """Makes the next tick."""

    def run_to_step(self, step: int) -> None:
        """Simulates up to a step, at most to the next tick, which is not made."""


class Replaying:
    """Makes one run again.

    Args:
        replay: the run, and the moment.
        loop: the loop of its world.
        obey: obeys a message of the session.
        send: sends a message to the session.
        fingerprint: returns the fingerprint of the tick that was made last.
        clock: returns the real time in s.
        given: the number of inputs that were given already, in the run from which this one was copied.
        resets: the number of resets among them.
    """

    def __init__(  # noqa: PLR0913 - a run, and what makes it
        self,
        replay: Replay,
        loop: Loop,
        *,
        obey: Callable[[ToExact], None],
        send: Callable[[GoingBack | Differs], None],
        fingerprint: Callable[[], bytes],
        clock: Callable[[], float] = time.monotonic,
        given: int = 0,
        resets: int = 0,
    ) -> None:
        self._replay = replay
        self._loop = loop
        self._obey = obey
        self._send = send
        self._fingerprint = fingerprint
        self._clock = clock
        self._given = given
        self._resets = resets
        self._told_s = clock()
        self._has_differed = False
        self._ticks = len(replay.fingerprints) // FINGERPRINT_BYTES
        self._most_ticks = self._ticks + replay.shows_source

    def run(self) -> WentBack:
        """Makes the run again up to the moment, and returns where it is then.

        Raises:
            NotThereError: an input has no place any more, since the run differs.
        """
        while not self._is_there():
            self._loop.run_to_tick(self._between)
            self._compare()
            self._tell()
        if self._replay.until_s is None:
            self._to_end()
        loop = self._loop
        return WentBack(
            t=loop.time_s, ticks=loop.ticks, inputs=self._given, resets=self._resets, tick_hz=loop.tick_hz
        )

    @property
    def is_at_moment(self) -> bool:
        """Whether the tick in progress, or just made, is the one at the moment."""
        replay, loop = self._replay, self._loop
        is_near = self._resets >= replay.resets and loop.ticks > 0
        return replay.until_s is not None and is_near and loop.time_s >= replay.until_s - EPSILON_S

    def held(self, hook: int) -> None:
        """Gives the next input to a tree that the debugger holds, as the first time.

        Raises:
            NotThereError: the first time nothing entered here.
        """
        if not self._give(hook):
            raise NotThereError(self._lost("The debugger held the tree here the first time, too, but longer"))

    def _is_there(self) -> bool:
        if self._loop.ticks >= self._most_ticks:
            return True  # a tick that did not end may be what ended the run
        return self.is_at_moment

    def _between(self) -> None:
        """Gives the inputs of this step."""
        while self._give(-1):
            pass

    def _give(self, hook: int) -> bool:
        """Gives the next input, if this is its place; returns whether it was."""
        next_, loop = self._next(), self._loop
        if next_ is None:
            return False
        if (next_.tick, next_.step, next_.hook) != (loop.ticks, loop.step_number, hook):
            if next_.tick < loop.ticks:
                raise NotThereError(self._lost("An input of the first time has no place any more"))
            return False
        self._given += 1
        message = decode_to_exact(next_.message)
        self._obey(message)
        if isinstance(input_of(message), Reset):
            self._resets += 1
        return True

    def _next(self) -> Input | None:
        inputs = self._replay.inputs
        return inputs[self._given] if self._given < len(inputs) else None

    def _to_end(self) -> None:
        """Gives what entered after the last tick."""
        loop = self._loop
        while (next_ := self._next()) is not None and (next_.tick, next_.hook) == (loop.ticks, -1):
            loop.run_to_step(next_.step)
            if not self._give(-1):
                return

    def _compare(self) -> None:
        number = self._loop.ticks
        at = (number - 1) * FINGERPRINT_BYTES
        known = self._replay.fingerprints[at : at + FINGERPRINT_BYTES]
        if not known or known == self._fingerprint() or self._has_differed:
            return
        self._has_differed = True
        self._send(Differs(number, self._loop.time_s, NOT_REPEATED))

    def _tell(self) -> None:
        now_s = self._clock()
        if now_s - self._told_s < TOLD_S:
            return
        self._told_s = now_s
        until_s, loop = self._replay.until_s, self._loop
        share = loop.ticks / max(1, self._ticks)
        if until_s and not self._replay.resets:
            share = max(share, loop.time_s / until_s)
        self._send(GoingBack(min(1.0, share)))

    def _lost(self, what: str) -> str:
        return f"{what} (tick {self._loop.ticks}, {self._loop.time_s:.2f} s): the run is not repeatable"
