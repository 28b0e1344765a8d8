"""Inputs of an exact run, and how it is made again.

These are parts of messages of `executor.child_messages`.
"""

from __future__ import annotations

from msgspec import Struct

__all__ = ["FINGERPRINT_BYTES", "Input", "Replay"]

FINGERPRINT_BYTES = 8
"""The bytes of the fingerprint of a tick."""


class Input(Struct, array_like=True, frozen=True):
    """A message from outside that changed a run, and its place in the run.

    Attributes:
        tick: the number of ticks that were begun before, since the run began.
        step: the step of the world.
        hook: the number of the stop within the tick at which the debugger held; -1 between two ticks.
        message: the message, encoded as on the channel.
    """

    tick: int
    step: int
    hook: int
    message: bytes


class Replay(Struct):
    """Makes a run again, up to a moment: just after the first tick that is not earlier.

    Attributes:
        inputs: what came from outside, in order.
        fingerprints: those of the ticks that ended, each of `FINGERPRINT_BYTES`. No more ticks are made.
        until_s: the simulated time in s; with None the run is made again to its end, with all inputs.
        resets: the number of times that the world was reset before the moment.
        shows_source: whether the code of the project is followed through the tick at the moment. The tick may
            be one that did not end: its begin is no less of interest.
    """

    inputs: list[Input]
    fingerprints: bytes
    until_s: float | None
    resets: int = 0
    shows_source: bool = False
