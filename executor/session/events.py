"""Input (events) and output (effects) of the session's state machine.

Times are seconds of a monotonic clock and are arguments: the state machine never reads a clock.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from executor.launching.model import LaunchPlan

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.adapter_messages import FromAdapter, ToAdapter
    from executor.child_messages import (
        FromExact,
        FromWorld,
        ToExact,
        ToWorld,
    )
    from executor.evaluation_messages import FromEvaluation, ToEvaluation
    from executor.launching.model import NodeSpec
    from executor.recorder_messages import FromRecorder, ToRecorder
    from executor.universes.document import Problem

__all__ = [
    "AttachWanted",
    "ChildExited",
    "ChildLooked",
    "ChildSaid",
    "ChildTraced",
    "ClientJoined",
    "ClientLeft",
    "CommandCame",
    "DropSnapshot",
    "Effect",
    "EndSession",
    "Event",
    "Inspect",
    "Interrupt",
    "Kill",
    "Kind",
    "RecordingWanted",
    "Retire",
    "Send",
    "SnapshotEnded",
    "SnapshotWeighed",
    "Spawn",
    "StreamClosed",
    "StreamOpened",
    "StreamPaced",
    "Tell",
    "TimePassed",
    "Unpack",
    "Unpacked",
    "WakeSnapshot",
]

Kind = Literal[
    "world", "application", "exact", "node", "recorder", "evaluation", "adapter", "trying", "source"
]
"""Kind of a child process; `node` is an extra node of the launch files.

`exact` is only the program of an application that has its world in it; `trying` and `source` are such
processes beside the ladder.
"""


@dataclass(frozen=True)
class ClientJoined:
    """A control socket was opened; `client` comes from `Session.client_id`.

    `user` is who uses it, as the web server says; None if nobody vouches for a name.
    """

    client: str
    user: str | None = None


@dataclass(frozen=True)
class ClientLeft:
    """A control socket was closed."""

    client: str


@dataclass(frozen=True)
class StreamOpened:
    """A client's stream socket was opened: it needs the scene and all poses again."""

    client: str


@dataclass(frozen=True)
class StreamPaced:
    """The share of a client's pictures that were replaced by newer ones before they could be sent, 0 to 1."""

    client: str
    lost: float


@dataclass(frozen=True)
class StreamClosed:
    """A client's stream socket was closed."""

    client: str


@dataclass(frozen=True)
class CommandCame:
    """A client sent a well-formed command; `data` is of the type that `COMMANDS` names."""

    client: str
    request: str
    command: str
    data: Struct


@dataclass(frozen=True)
class ChildSaid:
    """A child sent a message; `number` distinguishes it from earlier children of its kind."""

    kind: Kind
    number: int
    message: FromWorld | FromExact | FromRecorder | FromEvaluation | FromAdapter


@dataclass(frozen=True)
class ChildExited:
    """A child process ended; `reason` is a sentence with its exit code or signal."""

    kind: Kind
    number: int
    reason: str
    last_lines: tuple[str, ...] = ()


@dataclass(frozen=True)
class ChildLooked:
    """A sample of a child's state as the kernel reports it, several times a second.

    `state` is the kernel's letter for the state. Since the last sample the main thread ran for `ran_s`, and
    waited for a processor for `waited_s`.
    """

    kind: Kind
    number: int
    state: str
    ran_s: float
    waited_s: float


@dataclass(frozen=True)
class ChildTraced:
    """The result of `Inspect`: the stacks as faulthandler writes them, or "".

    `uid` is the tree node that was being ticked; 0 if none.
    """

    kind: Kind
    number: int
    text: str = ""
    uid: int = 0


@dataclass(frozen=True)
class SnapshotEnded:
    """A snapshot ended; `child` is the number of the process that made it, and `snapshot` its own."""

    child: int
    snapshot: int


@dataclass(frozen=True)
class SnapshotWeighed:
    """The memory that a snapshot has for itself, and the room for more; None without a limit."""

    child: int
    snapshot: int
    size_bytes: int
    room_bytes: int | None = None


@dataclass(frozen=True)
class Unpacked:
    """An archive was unpacked into `folder`, or refused with `error`.

    `plan` holds the nodes of the launch files; `problem` names a launch file that cannot be read, with the
    reason.
    """

    token: int
    folder: str = ""
    error: str = ""
    plan: LaunchPlan = field(default_factory=LaunchPlan)
    problem: tuple[str, Problem] | None = None


@dataclass(frozen=True)
class RecordingWanted:
    """The session is to be recorded, into a folder; `is_whole` if nothing may be dropped later."""

    folder: str
    is_whole: bool = False


@dataclass(frozen=True)
class AttachWanted:
    """The session is to follow the program at an address; `folder` gets its diagrams."""

    address: str
    folder: str


@dataclass(frozen=True)
class TimePassed:
    """The time `Session.deadline_s` was reached."""


Event = (
    ClientJoined
    | ClientLeft
    | StreamOpened
    | StreamClosed
    | StreamPaced
    | CommandCame
    | ChildSaid
    | ChildLooked
    | ChildTraced
    | ChildExited
    | SnapshotEnded
    | SnapshotWeighed
    | Unpacked
    | RecordingWanted
    | AttachWanted
    | TimePassed
)


@dataclass(frozen=True)
class Send:
    """Sends an event to a client, or to all with None.

    `request` is the id of the command that the event answers.
    """

    client: str | None
    name: str
    payload: Struct
    request: str | None = None


@dataclass(frozen=True)
class Spawn:
    """Starts a child process. A failure is reported with `ChildExited`.

    For a launch node, `node` is the node to start and `folder` its working folder. An application is the
    process of exact runs if it `is_exact`.
    """

    kind: Kind
    number: int
    node: NodeSpec | None = None
    folder: str = ""
    is_exact: bool = False


@dataclass(frozen=True)
class Tell:
    """Sends a message to a child. It is dropped if the child is gone: `ChildExited` follows anyway."""

    kind: Kind
    number: int
    message: ToWorld | ToExact | ToRecorder | ToEvaluation | ToAdapter


@dataclass(frozen=True)
class Interrupt:
    """Interrupts the current tick of a child by a signal."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Inspect:
    """Dumps the stacks of a silent child, and reports them with `ChildTraced`."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Retire:
    """Waits up to `grace_s` for a child that has received `Stop`, then kills its remaining processes."""

    kind: Kind
    number: int
    grace_s: float


@dataclass(frozen=True)
class Kill:
    """Kills a child and its descendants immediately."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class WakeSnapshot:
    """Forks a copy of a snapshot, which is the application with a number from then on.

    A failure is reported with `ChildExited`.
    """

    child: int
    snapshot: int
    number: int
    kind: Kind = "application"


@dataclass(frozen=True)
class DropSnapshot:
    """Ends a snapshot."""

    child: int
    snapshot: int


@dataclass(frozen=True)
class Unpack:
    """Unpacks an archive (base64) into a new folder, and reports the result with `Unpacked`.

    `needed` are the folders that stay: of the application that runs, and of what can be run again.
    """

    token: int
    archive_base64: str
    needed: frozenset[str] = frozenset()


@dataclass(frozen=True)
class EndSession:
    """Ends the manager, since no client reconnected within the grace period."""

    reason: str


Effect = (
    Send
    | Spawn
    | Tell
    | Interrupt
    | Inspect
    | Retire
    | Kill
    | WakeSnapshot
    | DropSnapshot
    | Unpack
    | EndSession
)
