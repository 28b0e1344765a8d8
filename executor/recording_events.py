"""The events of a recording: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Literal

from msgspec import Struct

StopReason = Literal["disk_full", "disk_failed", "recorder_died", "recorder_hung"]
RunResult = Literal["success", "failure", "fault", "collision", "stopped"]


class Segment(Struct):
    """A part of the recording of a run: 20 s of simulated time, and an MCAP file by itself.

    It is sent again each second while it grows: `bytes` of it can be read then. `complete` tells that it has
    its end. A new `version` replaces it when old pictures were removed; with 0 `bytes` it is gone.
    `run_number` counts the runs of the session from 1, and stays with a run when others are thrown away.
    `result` says how the run ended, once it has: by the status of the root, by a fault, or stopped by the
    user; one that is stopped after its robot bumped into something ended by that `collision`.
    """

    run: str
    branch: int
    number: int
    version: int
    from_t: float
    to_t: float
    bytes: int
    complete: bool = False
    run_number: int = 0
    result: RunResult | None = None


class FlagSet(Struct):
    """A flag of the user was set or changed in a run, at a moment in s; with an empty `text` it is gone."""

    run: str
    id: str
    t: float
    text: str
    user: str = ""


class RecordingStopped(Struct):
    """The recording of a run stopped at a simulated time in s; the run itself continues.

    What happens from then on is missing: until another recorder has started if it `goes_on`, else to the end
    of the run. `detail` is the cause as the system tells it.
    """

    run: str
    t: float
    reason: StopReason
    detail: str
    goes_on: bool


class Branch(Struct):
    """A run continues another one: `run` is as `parent` was up to the moment `from_t` in s.

    It is sent again when the branch gets a `name`, and when it was thrown away (`is_gone`).
    """

    run: str
    parent: str
    from_t: float
    name: str = ""
    is_gone: bool = False


class RepeatableRuns(Struct):
    """The runs of this session in which one can go back, the present or last one at the end.

    Of those that are `live`, the world goes back to a recorded state, and the tree begins again there. In
    those of `by_hand` the Python debugger has changed the program, at a moment in s: one can go back only to
    an earlier one.
    """

    runs: list[str]
    live: list[str] = []
    by_hand: dict[str, float] = {}


class GoingBack(Struct):
    """A run is made again up to a moment; `fraction` is 0 to 1, and 1 also where that failed."""

    fraction: float


class Differs(Struct):
    """A run that is made again differs from the first time, from a tick on, at a simulated time `t` in s.

    `cause` names what may not be repeatable in the program.
    """

    tick: int
    t: float
    cause: str
