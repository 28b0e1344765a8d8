"""Messages to and from an exact run (`executor.exact.process`), which is world and application in one."""

from __future__ import annotations

from executor import source_events, trying_events
from executor.child_messages.application import SetPort  # noqa: TC001 - msgspec reads the annotations
from executor.child_messages.common import Message
from executor.child_messages.world import WorldCommand  # noqa: TC001 - msgspec reads the annotations
from executor.replay_messages import Input, Replay  # noqa: TC001 - msgspec reads the annotations


class KeepSnapshots(Message, tag="keep_snapshots"):
    """Sets whether the run makes snapshots of itself."""

    is_on: bool


class TakeSnapshot(Message, tag="take_snapshot"):
    """Makes a snapshot now; the answer is a `SnapshotTaken` or a `NoSnapshots`."""


class NewSeed(Message, tag="new_seed"):
    """Draws noise and random numbers from another seed from now on."""

    seed: int


class TryMany(Message, tag="try_many"):
    """Continues the run from here once as it is, and once with each change, each in a copy of the process.

    The run itself stays where it is. `changes` are orders for ports, or seeds.
    """

    job: str
    changes: list[SetPort | NewSeed]
    duration_s: float


class Awake(Message, tag="awake"):
    """Makes the copy of a snapshot make the run again from there, up to a moment."""

    replay: Replay
    speed: float


class ForWorld(Message, tag="for_world"):
    """A command for the world of an exact run."""

    command: WorldCommand


class Entered(Message, tag="entered"):
    """Something from outside changed the run."""

    input: Input


class Fingerprints(Message, tag="fingerprints"):
    """The fingerprints of the ticks since the last such message, one after the other."""

    data: bytes


class GoingBack(Message, tag="going_back"):
    """The share of the way to the moment of a `Replay`, 0 to 1."""

    fraction: float


class Differs(Message, tag="differs"):
    """The run that is made again differs from the first time from a tick on, at a simulated time in s."""

    tick: int
    t: float
    cause: str


class WentBack(Message, tag="went_back"):
    """The run was made again up to the moment of a `Replay`; it is paused there.

    Attributes:
        t: the simulated time in s.
        ticks: the number of ticks that were made.
        inputs: the number of inputs that were given.
        resets: the number of resets of the world among them.
        tick_hz: the ticks in a second of simulated time.
    """

    t: float
    ticks: int
    inputs: int
    resets: int
    tick_hz: float


class SnapshotTaken(Message, tag="snapshot_taken"):
    """The run has made a snapshot of itself.

    Attributes:
        number: its number in this process.
        t: the simulated time in s.
        ticks: the number of ticks that were made before.
        inputs: the number of inputs that had entered.
        resets: the number of resets of the world among them.
        is_at_tick: whether nothing was simulated since the last tick.
        cost_s: the processor time in s that the run had taken up to there.
        draws: whether the run draws pictures.
        is_wanted: whether the session asked for it.
    """

    number: int
    t: float
    ticks: int
    inputs: int
    resets: int
    is_at_tick: bool
    cost_s: float
    draws: bool = False
    is_wanted: bool = False


class NoSnapshots(Message, tag="no_snapshots"):
    """The run makes no snapshots of itself now, for a reason: the end of a sentence."""

    reason: str
    is_wanted: bool = False


class TryingStarted(trying_events.TryingStarted, tag_field="type", tag="trying_started"):
    """The event `trying_started` for clients."""


class TryingProgress(trying_events.TryingProgress, tag_field="type", tag="trying_progress"):
    """The event `trying_progress` for clients."""


class TryOutcome(trying_events.TryOutcome, tag_field="type", tag="try_outcome"):
    """The event `try_outcome` for clients."""


class TryingEnded(trying_events.TryingEnded, tag_field="type", tag="trying_ended"):
    """The event `trying_ended` for clients."""


class TickSource(source_events.TickSource, tag_field="type", tag="tick_source"):
    """The event `tick_source` for clients."""
