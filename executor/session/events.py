"""Input (events) and output (effects) of the session's state machine.

Times are seconds of a monotonic clock and are arguments: the machine never reads one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from executor.launching.model import LaunchPlan

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.child_messages import FromApplication, FromWorld, ToApplication, ToWorld
    from executor.launching.model import NodeSpec
    from executor.universes.document import Problem

__all__ = [
    "ChildExited",
    "ChildLooked",
    "ChildSaid",
    "ChildTraced",
    "ClientJoined",
    "ClientLeft",
    "CommandCame",
    "Effect",
    "EndSession",
    "Event",
    "Inspect",
    "Interrupt",
    "Kill",
    "Kind",
    "Retire",
    "Send",
    "Spawn",
    "StreamClosed",
    "StreamOpened",
    "StreamPaced",
    "Tell",
    "TimePassed",
    "Unpack",
    "Unpacked",
]

Kind = Literal["world", "application", "node"]
"""Kind of a child process; `node` is an extra node of the launch files."""


# --- events ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class ClientJoined:
    """A control socket was opened; `client` comes from `Session.client_id`."""

    client: str


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
    message: FromWorld | FromApplication


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

    `state` is the kernel's letter for it. Since the last sample its main thread ran for `ran_s`, and waited
    for a processor for `waited_s`.
    """

    kind: Kind
    number: int
    state: str
    ran_s: float
    waited_s: float


@dataclass(frozen=True)
class ChildTraced:
    """The result of `Inspect`: the text of faulthandler, or "".

    `uid` is the tree node that was being ticked; 0 if none.
    """

    kind: Kind
    number: int
    text: str = ""
    uid: int = 0


@dataclass(frozen=True)
class Unpacked:
    """An archive was unpacked into `folder`, or refused with `error`.

    `plan` holds the nodes of its launch files; `problem` is the file that cannot be read, and why.
    """

    token: int
    folder: str = ""
    error: str = ""
    plan: LaunchPlan = field(default_factory=LaunchPlan)
    problem: tuple[str, Problem] | None = None


@dataclass(frozen=True)
class TimePassed:
    """`Session.deadline_s` is over."""


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
    | Unpacked
    | TimePassed
)


# --- effects --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Send:
    """Send an event to a client (None: to all); `request` is the id of the command that it answers."""

    client: str | None
    name: str
    payload: Struct
    request: str | None = None


@dataclass(frozen=True)
class Spawn:
    """Start a child process. A failure is reported with `ChildExited`.

    `node` is the extra node to start, in `folder`.
    """

    kind: Kind
    number: int
    node: NodeSpec | None = None
    folder: str = ""


@dataclass(frozen=True)
class Tell:
    """Send a message to a child. It is dropped if the child is gone: `ChildExited` follows anyway."""

    kind: Kind
    number: int
    message: ToWorld | ToApplication


@dataclass(frozen=True)
class Interrupt:
    """Interrupt the child's current tick by a signal."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Inspect:
    """Dump the stacks of a silent child, and report them with `ChildTraced`."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Retire:
    """Wait up to `grace_s` for a child that has received `Stop`, then kill what is left of it."""

    kind: Kind
    number: int
    grace_s: float


@dataclass(frozen=True)
class Kill:
    """Kill a child and its descendants at once."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Unpack:
    """Unpack an archive (base64) into a folder of its own, and report with `Unpacked`."""

    token: int
    archive_base64: str


@dataclass(frozen=True)
class EndSession:
    """End the manager: no client reconnected within the grace period."""

    reason: str


Effect = Send | Spawn | Tell | Interrupt | Inspect | Retire | Kill | Unpack | EndSession
