"""The source of a past tick: a run of the session is made again up to it, and its code is followed there.

A process of its own does it, beside the ladder; it is ended as soon as it has said what the tick ran.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import msgspec
from msgspec import structs

from executor import child_messages, messages
from executor.session.exact.aside import LATE, Aside
from executor.source_events import MOST_SOURCE_BYTES

if TYPE_CHECKING:
    from executor.session.events import ChildExited, ChildSaid, CommandCame
    from executor.session.stage import Stage

__all__ = ["Sources"]

BEFORE_S: Final = 1e-3
"""A snapshot that is not so long before the tick may be one from after it; a step of the world is longer."""
MOST_BYTES: Final = 2 * MOST_SOURCE_BYTES
MOST_CHARACTERS: Final = 2000
LIVE: Final = "A live run cannot be made again, so nobody knows which lines a past tick ran."
NO_TICK: Final = "The run has no tick at this moment that could be made again."
TOO_LARGE: Final = "The tick did too much to be shown."
CANCELLED: Final = "It was stopped."


@dataclass
class _Job:
    """A job, and who hears of it."""

    name: str
    client: str
    request: str
    differs: int | None = None


class Sources:
    """The sources of past ticks that clients ask for: one at a time."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._aside = Aside(stage, "source")
        self._job: _Job | None = None

    def begin(self, event: CommandCame, data: messages.SourceOfTick) -> None:
        """Begins a job; another one that runs is ended."""
        past = self._aside.found(event, data.run, data.t, LIVE)
        if past is None:
            return
        self.stop()
        self._stage.output.send(event.client, messages.Ack(), event.request)
        self._job = _Job(data.job, event.client, event.request)
        replay = structs.replace(past.replay(data.t), shows_source=True)
        self._aside.begin(past, replay, data.t - BEFORE_S)

    def stop(self, name: str = "") -> None:
        """Ends the job, if it has this name; "" is any."""
        if self._job is not None and name in ("", self._job.name):
            self._fail(CANCELLED)

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the process; users' code runs in it."""
        message, job = self._aside.said(event), self._job
        if message is None or job is None:
            return
        match message:
            case child_messages.GoingBack(fraction=fraction):
                self._tell(job, messages.SourceProgress(job.name, min(1.0, max(0.0, fraction))))
            case child_messages.Differs(tick=tick):
                job.differs = tick if job.differs is None else job.differs
            case child_messages.TickSource():
                self._show(job, message)
            case child_messages.ApplicationReady():
                self._fail(NO_TICK)
            case child_messages.Fault(kind="load"):
                self._fail(f"{message.message} {message.hint}".strip())
            case _:
                pass

    def exited(self, event: ChildExited) -> None:
        """Notes that the process has ended; without its last word it has failed."""
        if reason := self._aside.exited(event):
            self._fail(reason)

    def looked(self, now_s: float) -> None:
        """Ends a job whose process makes no progress."""
        if self._aside.is_silent(now_s):
            self._fail(LATE)

    def _show(self, job: _Job, message: child_messages.TickSource) -> None:
        found = child_messages.event_of(message, messages.TickSource)
        found = structs.replace(found, job=job.name, differs=job.differs, problem="")
        if len(msgspec.json.encode(found)) > MOST_BYTES:
            self._fail(TOO_LARGE)
            return
        self._end(job, found)

    def _fail(self, problem: str) -> None:
        if self._job is not None:
            self._end(self._job, messages.TickSource(self._job.name, problem=problem[:MOST_CHARACTERS]))

    def _end(self, job: _Job, source: messages.TickSource) -> None:
        self._job = None
        self._aside.end()
        self._tell(job, source)

    def _tell(self, job: _Job, event: messages.SourceProgress | messages.TickSource) -> None:
        # As an answer it is never dropped.
        self._stage.output.send(job.client, event, job.request)
