"""What goes into the session's state machine (events) and what comes out of it (effects).

Times are seconds of a monotonic clock and are given by the caller: the machine never looks at one.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from executor.launching.model import LaunchPlan

if TYPE_CHECKING:
    from msgspec import Struct

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
"""What a child process is for."""


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
    """A client's stream socket was opened: it needs its streams whole."""

    client: str


@dataclass(frozen=True)
class StreamPaced:
    """A client's share of pictures that newer ones overtook before they could be sent, 0 to 1."""

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
    """A child sent a message; `number` tells it from earlier ones of its kind."""

    kind: Kind
    number: int
    message: dict[str, Any]


@dataclass(frozen=True)
class ChildExited:
    """A child process ended; `reason` is a sentence with its exit code or signal."""

    kind: Kind
    number: int
    reason: str
    last_lines: tuple[str, ...] = ()


@dataclass(frozen=True)
class ChildLooked:
    """The supervisor looked at a child from outside, as it does several times a second.

    `state` is Linux's letter. `ran_s` is what its main thread computed since the last look, `waited_s` how
    long it could have and got no processor.
    """

    kind: Kind
    number: int
    state: str
    ran_s: float
    waited_s: float


@dataclass(frozen=True)
class ChildTraced:
    """A child was asked by `Inspect` where it is: faulthandler's text, "" if it did not say.

    `uid` is the node that it was ticking; 0 if none.
    """

    kind: Kind
    number: int
    text: str = ""
    uid: int = 0


@dataclass(frozen=True)
class Unpacked:
    """An archive was unpacked into `folder`, or refused with `error`.

    `plan` is what its launch files ask for; `problem` names the file that cannot be read, and why.
    """

    token: int
    folder: str = ""
    error: str = ""
    plan: LaunchPlan = field(default_factory=LaunchPlan)
    problem: tuple[str, Problem] | None = None


@dataclass(frozen=True)
class TimePassed:
    """Nothing happened, but `Session.deadline_s` is over."""


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
    """Start a child process. If that fails, say so with `ChildExited`.

    `node` is what to start for an extra node, in `folder`.
    """

    kind: Kind
    number: int
    node: NodeSpec | None = None
    folder: str = ""


@dataclass(frozen=True)
class Tell:
    """Send a message to a child. To one that is gone it is dropped: `ChildExited` follows anyway."""

    kind: Kind
    number: int
    message: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Interrupt:
    """Signal a child that its tick is to be broken off."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Inspect:
    """Ask a child that is silent where its threads are, and say so with `ChildTraced`."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Retire:
    """Let a child that was told to stop end by itself within `grace_s`, then kill what is left of it."""

    kind: Kind
    number: int
    grace_s: float


@dataclass(frozen=True)
class Kill:
    """End a child and all that it started, now."""

    kind: Kind
    number: int


@dataclass(frozen=True)
class Unpack:
    """Unpack an archive (base64) into a folder of its own and say so with `Unpacked`."""

    token: int
    archive_base64: str


@dataclass(frozen=True)
class EndSession:
    """Nobody came back within the grace period: end the manager."""

    reason: str


Effect = Send | Spawn | Tell | Interrupt | Inspect | Retire | Kill | Unpack | EndSession
