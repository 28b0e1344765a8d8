"""Base structs, signs of life and output that all channels between the manager and its children share."""

from __future__ import annotations

from typing import TypeVar

import msgspec
from msgspec import Struct

from executor import messages  # noqa: TC001 - msgspec reads the annotations

Event = TypeVar("Event", bound=Struct)


class Message(Struct, tag_field="type", omit_defaults=True):
    """Base class of messages without an answer."""


class Asked(Struct, tag_field="type", omit_defaults=True, kw_only=True):
    """Base class of a request or of its answer.

    `request` is its token, or None if no client waits for an answer.
    """

    request: str | None = None


class Stop(Message, tag="stop"):
    """Ends the process."""


class Pause(Asked, tag="pause"):
    """Pauses simulated time, or ticks."""


class Resume(Asked, tag="resume"):
    """Resumes simulated time, or ticks."""


class BeginRecording(Message, tag="begin_recording"):
    """Begins the recording of a run: all that follows belongs to it.

    With `resets` simulated time goes back to 0 now; the application notices it a little later.
    """

    run: str
    resets: bool = False


class Place(Struct, omit_defaults=True):
    """The place of a child's main thread: `text` for people.

    The other fields are set while it runs an action.
    """

    text: str = ""
    node_id: str = ""
    tree_id: str = ""
    node_path: str = ""
    node_type: str = ""
    file: str = ""
    line: int = 0
    traceback: str = ""


class Beat(Message, tag="beat"):
    """Sign of life of a child (`executor.supervision.pulse`).

    Attributes:
        turns: number of times that the main thread completed its loop.
        task: the name of the thing that the main thread loads; "" after loading, while it runs its loop.
        clocks: number of times that simulated time was published (world) or received (application).
        place: the place of the main thread, if it has not completed its loop for a while.
        ticks: number of ticks that an exact run has begun.
    """

    turns: int
    task: str = ""
    clocks: int = 0
    place: Place | None = None
    ticks: int = 0


class Log(Message, tag="log"):
    """One line of output; if `time` is None, the session's own time is used."""

    level: messages.LogLevel
    text: str
    node_id: str = ""
    node_path: str = ""
    time: float | None = None
    of_world: bool = False
    """Whether the world wrote it, in a process that also runs the application."""


class Starting(Message, tag="starting"):
    """The child received its start message."""


class Answer(Asked, tag="answer"):
    """A request was carried out, or failed with an error."""

    error: messages.Error | None = None


def name_of(message: Struct) -> str:
    """Returns the tag of a message."""
    return str(type(message).__struct_config__.tag)


def event_of(message: Struct, event: type[Event]) -> Event:
    """Returns the event that a message extends, without the fields that only the channel uses.

    Nested structs are shared, not copied.
    """
    return msgspec.convert(message, event, from_attributes=True)
