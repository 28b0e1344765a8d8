"""The commands and the events of *Try many*: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

MOST_VALUES = 50
LONGEST_S = 120
PATH_POINTS = 200
MOST_OUTLINES = 500
LARGEST_SEED = 2**32 - 1

TryingName = Annotated[str, Meta(pattern=r"^[0-9a-f]{1,32}$")]
TriedValue = Annotated[str, Meta(max_length=4096)]
TriedSeed = Annotated[int, Meta(ge=0, le=LARGEST_SEED)]
TryEnd = Literal["running", "finished", "fault", "refused", "held", "died", "late"]
TryingEnd = Literal["complete", "refused", "failed", "cancelled"]


class TryValues(Struct, forbid_unknown_fields=True):
    """Continues a run from a moment under several values of a port, beside the ladder.

    Nothing of it happens in the world of the session. The run is made again up to the moment `t` in s as by
    `go_back`, then continued for `duration_s` once as it is (index 0), and once with each of `values`. Each
    value is what `set_port` would take; null removes the text. One job runs at a time; another one ends it.

    Refused with `no_run`, `unknown_run`, `not_repeatable`, with `live_run` for a live run, or with
    `changed_by_hand` for a moment after which the debugger had changed the program.
    """

    job: TryingName
    node_id: Annotated[str, Meta(max_length=255)]
    path: Annotated[str, Meta(min_length=1, max_length=65536)]
    port: Annotated[str, Meta(min_length=1, max_length=255)]
    values: Annotated[list[TriedValue | None], Meta(min_length=1, max_length=MOST_VALUES)]
    duration_s: Annotated[float, Meta(gt=0, le=LONGEST_S)] = 10.0
    run: Annotated[str, Meta(max_length=64)] = ""
    t: Annotated[float, Meta(ge=0)] | None = None


class TrySeeds(Struct, forbid_unknown_fields=True):
    """Continues a run from a moment under several seeds, beside the ladder.

    As `try_values`, but what differs from the moment on are random numbers: the noise of sensors and wheels,
    and `random` and `numpy.random` in actions. What the universe drew at its begin stays. The seed with which
    the run began changes nothing: its continuation is the run as it is.
    """

    job: TryingName
    seeds: Annotated[list[TriedSeed], Meta(min_length=1, max_length=MOST_VALUES)]
    duration_s: Annotated[float, Meta(gt=0, le=LONGEST_S)] = 10.0
    run: Annotated[str, Meta(max_length=64)] = ""
    t: Annotated[float, Meta(ge=0)] | None = None


class StopTrying(Struct, forbid_unknown_fields=True):
    """Ends a job of `try_values` or `try_seeds`, if it runs; what is known of it stays with the client."""

    job: TryingName


class TryingStarted(Struct):
    """The run is back at the moment, and its continuations begin.

    Attributes:
        t: the moment in s.
        at_once: how many run at the same time.
        outlines: the corners [x, y] in m of what stands in the world at the moment.
    """

    job: str
    t: float
    at_once: int
    outlines: list[list[tuple[float, float]]]


class TryingProgress(Struct):
    """The share of a job that is done, 0 to 1; `stage` is `going_back`, or `continuing`."""

    job: str
    stage: Literal["going_back", "continuing"]
    fraction: float


class Crash(Struct):
    """The begin of a collision of a robot: its time in s, its place in m, and what it hit."""

    t: float
    x: float
    y: float
    body: str
    robot: str


class TryOutcome(Struct):
    """The outcome of one continuation.

    Attributes:
        index: 0 for the run as it is; n for the n-th value or seed.
        end: how it ended; `running` if it still ran when its time was over, `refused` if the port does not
            take the value, `held` if the debugger would hold it, `late` if a tick did not return.
        message: why, for all ends but `running`.
        t: the simulated time of the end in s.
        ticks: the number of ticks.
        root: the last result of the tree.
        nodes: the paths of the leaves that were RUNNING at the end.
        distance_m: how far the first robot drove.
        collisions: the number of collisions of all robots.
        crash: the first of them.
        paths: by robot, where it was: [time in s, x, y in m].
        fingerprint: equal for continuations that did the same in each tick.
        as_before: whether each tick was as in the recorded run, as far as that went; None if it ended there.
    """

    job: str
    index: int
    end: TryEnd
    message: str = ""
    t: float = 0.0
    ticks: int = 0
    root: str = ""
    nodes: list[str] = []
    distance_m: float = 0.0
    collisions: int = 0
    crash: Crash | None = None
    paths: dict[str, list[tuple[float, float, float]]] = {}
    fingerprint: str = ""
    as_before: bool | None = None


class TryingEnded(Struct):
    """A job has ended; `message` says why it was refused or failed."""

    job: str
    end: TryingEnd
    message: str = ""
