"""Messages between the manager and the recorder; those of other children are in `executor.child_messages`."""

from __future__ import annotations

from typing import Any, Final

import msgspec

from executor import messages  # noqa: TC001 - msgspec reads the annotations
from executor.child_messages import Answer, Asked, Beat, Frame, Log, Message, Stop


class StartRecorder(Message, tag="start"):
    """Records into a folder; the segments of an earlier recorder are taken over.

    With `is_whole` the recordings have no budgets.
    """

    folder: str
    is_whole: bool = False


class BeginRun(Message, tag="begin_run"):
    """Begins the recording of a run; `folder` has the files of its project.

    `universe` is the document of its universe; "" for a built-in one, which its name tells.
    """

    run: str
    about: dict[str, str]
    folder: str
    universe: str = ""


class ChangeFiles(Message, tag="change_files"):
    """The files of the project of a run are those in another folder: the next tree belongs to them."""

    run: str
    folder: str


class RunEvent(Message, tag="run_event"):
    """An event of the session that belongs to a run, at a simulated time in s."""

    run: str
    name: str
    t: float
    data: dict[str, Any]


class ReadSegment(Asked, tag="read_segment"):
    """Requests a part of a segment, which is sent to a client as a frame before the answer."""

    client: str
    run: str
    segment: int
    version: int
    offset: int
    length: int


class DropRun(Message, tag="drop_run"):
    """Removes the recording of an earlier run."""

    run: str


class FindKeyframe(Asked, tag="find_keyframe"):
    """Requests the last recorded state of a run's world that is not later than `t` in s; null is its end.

    A `WorldKeyframe` comes before the answer.
    """

    run: str
    t: float | None


class Recorded(Message, tag="recorded"):
    """The event `segment` for clients."""

    segment: messages.Segment


class Stopped(Message, tag="stopped"):
    """The recording of a run stopped at a simulated time in s, since the disk is full or fails."""

    run: str
    t: float
    reason: messages.StopReason
    detail: str


class WorldKeyframe(Message, tag="keyframe"):
    """The recorded state of a world at a moment `t` in s, and the blackboard, as in the recording."""

    t: float
    world: bytes
    blackboard_json: str


ToRecorder = StartRecorder | Stop | BeginRun | ChangeFiles | RunEvent | ReadSegment | FindKeyframe | DropRun
FromRecorder = Beat | Log | Answer | Frame | Recorded | Stopped | WorldKeyframe
decode_to_recorder: Final = msgspec.msgpack.Decoder(ToRecorder).decode
decode_from_recorder: Final = msgspec.msgpack.Decoder(FromRecorder).decode
