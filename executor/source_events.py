"""The commands and the events of the source of a past tick: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

MOST_CALLS = 100
MOST_VALUES = 40
MOST_SOURCE_BYTES = 1 << 20
"""The size of a `tick_source`; the texts of values and of files have half of it each."""

SourceJob = Annotated[str, Meta(pattern=r"^[0-9a-f]{1,32}$")]
CallEnd = Literal["returned", "raised", "open"]
CallPart = Literal["callback", "tick"]


class SourceOfTick(Struct, forbid_unknown_fields=True):
    """Makes a run again up to a past tick, and says which lines of the project's Python this tick ran.

    Nothing of it happens in the world of the session: a process of its own makes the run again as for
    `go_back`, and is ended. The tick is the first that is not earlier than `t` in s; the callbacks of ROS
    that ran just before it belong to it. One job runs at a time; another one ends it.

    Refused with `no_run`, `unknown_run`, `not_repeatable`, `live_run` for a live run, or `changed_by_hand`
    for a tick after the debugger has changed the program.
    """

    job: SourceJob
    t: Annotated[float, Meta(ge=0)]
    run: Annotated[str, Meta(max_length=64)] = ""


class StopSource(Struct, forbid_unknown_fields=True):
    """Ends a job of `source_of_tick`, if it runs."""

    job: SourceJob


class SourceProgress(Struct):
    """The share of the way to the tick, 0 to 1."""

    job: str
    fraction: float


class SourceValue(Struct):
    """A name and the beginning of its value as text; a field has the name `self.field`."""

    name: str
    text: str


class SourceLine(Struct):
    """A line that ran in a call.

    Attributes:
        line: its number in the file, from 1.
        times: how often it ran.
        values: what had another value after it ran, as it was after the last time.
    """

    line: int
    times: int
    values: list[SourceValue] = []


class SourceCall(Struct):
    """A call of a function of the project: of an action, or of a module that actions import.

    Attributes:
        file: the file in the project.
        function: the name of the function with that of its class.
        line: the line in which it begins.
        uid: the node whose action called; 0 if it is none.
        path: the path of this node.
        part: `callback` if ROS called it before the tick.
        end: how it ended; a generator that yields has returned. `open` if it was not followed to its end.
        result: what it returned, or the exception.
        lines: the lines that ran, in the order of the file.
        locals: its local variables at the end.
        fields: the fields of `self` at the end.
    """

    file: str
    function: str
    line: int
    uid: int
    path: str
    part: CallPart
    end: CallEnd = "open"
    result: str = ""
    lines: list[SourceLine] = []
    locals: list[SourceValue] = []
    fields: list[SourceValue] = []


class TickSource(Struct):
    """The end of a job of `source_of_tick`: what the code of the project did in the tick.

    Attributes:
        t: the time of the tick in s.
        tick: the number of the tick in the run.
        calls: the calls, in the order in which they began.
        files: the text of each file with a call, as it ran; a file that is too long is left out.
        left_out: the number of calls that are not in `calls`, since there were too many.
        is_cut: whether so much happened that lines and values are missing.
        differs: the tick from which the run that was made again differs from the recorded one; None if none.
        problem: why nothing can be shown; "" if something can.
    """

    job: str
    t: float = 0.0
    tick: int = 0
    calls: list[SourceCall] = []
    files: dict[str, str] = {}
    left_out: int = 0
    is_cut: bool = False
    differs: int | None = None
    problem: str = ""
