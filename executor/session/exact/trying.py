"""*Try many*: a run of the session continues from a moment under several values or seeds, beside the ladder.

A process of its own makes the run again up to the moment, from the newest snapshot before it or from its
begin, and continues it once with each value in a copy of itself. The world of the session takes no notice.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor import child_messages, messages
from executor.session.exact.aside import LATE, SILENT_S, Aside
from executor.trying_events import MOST_OUTLINES, PATH_POINTS

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.session.events import ChildExited, ChildSaid, CommandCame
    from executor.session.stage import Stage
    from executor.trying_events import TryingEnd

__all__ = ["SILENT_S", "Trying"]

MOST_CHARACTERS: Final = 2000
MOST_PATHS: Final = 8
LIVE: Final = "A live run cannot be continued from a moment: its world and its program are not one."


@dataclass
class _Job:
    """A job, and who hears of it."""

    data: messages.TryValues | messages.TrySeeds
    changes: list[child_messages.SetPort | child_messages.NewSeed]
    client: str
    request: str
    done: set[int] = field(default_factory=set)


class Trying:
    """The continuations of a session: one job at a time."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._aside = Aside(stage, "trying")
        self._job: _Job | None = None

    def begin(self, event: CommandCame, data: messages.TryValues | messages.TrySeeds) -> None:
        """Begins a job; another one that runs is ended."""
        past = self._aside.found(event, data.run, data.t, LIVE)
        if past is None:
            return
        self.stop()
        self._stage.output.send(event.client, messages.Ack(), event.request)
        self._job = _Job(data, _changes(data), event.client, event.request)
        replay = past.replay(data.t)
        self._aside.begin(past, replay, replay.until_s)

    def stop(self, name: str = "") -> None:
        """Ends the job, if it has this name; "" is any."""
        if self._job is not None and name in ("", self._job.data.job):
            self._end("cancelled")

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the process."""
        message, job = self._aside.said(event), self._job
        if message is None or job is None:
            return
        match message:
            case child_messages.GoingBack(fraction=fraction):
                self._tell(job, messages.TryingProgress(job.data.job, "going_back", fraction))
            case child_messages.ApplicationReady():
                self._aside.tell(child_messages.TryMany(job.data.job, job.changes, job.data.duration_s))
            case child_messages.Fault(kind="load"):
                self._end("failed", f"{message.message} {message.hint}".strip())
            case _ if self._aside.is_there:
                self._continued(job, message)
            case _:
                pass

    def exited(self, event: ChildExited) -> None:
        """Notes that the process has ended; without its last word it has failed."""
        if reason := self._aside.exited(event):
            self._end("failed", reason)

    def looked(self, now_s: float) -> None:
        """Ends a job whose process makes no progress."""
        if self._aside.is_silent(now_s):
            self._end("failed", LATE)

    def _continued(self, job: _Job, message: Struct) -> None:
        """Handles what the process says of the continuations; users' code runs in it."""
        name = job.data.job
        match message:
            case child_messages.TryingProgress(fraction=fraction):
                self._aside.heard()
                self._tell(job, messages.TryingProgress(name, "continuing", min(1.0, max(0.0, fraction))))
            case child_messages.TryingStarted():
                found = child_messages.event_of(message, messages.TryingStarted)
                self._tell(job, structs.replace(found, job=name, outlines=found.outlines[:MOST_OUTLINES]))
            case child_messages.TryOutcome(index=index) if self._is_new(job, index):
                job.done.add(index)
                self._tell(job, _bounded(child_messages.event_of(message, messages.TryOutcome), name))
            case child_messages.TryingEnded(end=end, message=text):
                is_whole = len(job.done) == len(job.changes) + 1
                self._end(end if is_whole or end != "complete" else "failed", text[:MOST_CHARACTERS])
            case _:
                pass

    def _is_new(self, job: _Job, index: int) -> bool:
        return 0 <= index <= len(job.changes) and index not in job.done

    def _end(self, end: TryingEnd, message: str = "") -> None:
        job, self._job = self._job, None
        if job is None:
            return
        self._aside.end()
        self._tell(job, messages.TryingEnded(job.data.job, end, message))

    def _tell(
        self,
        job: _Job,
        event: messages.TryingStarted | messages.TryingProgress | messages.TryOutcome | messages.TryingEnded,
    ) -> None:
        # As an answer it is never dropped.
        self._stage.output.send(job.client, event, job.request)


def _changes(
    data: messages.TryValues | messages.TrySeeds,
) -> list[child_messages.SetPort | child_messages.NewSeed]:
    """Returns what each continuation changes at the moment."""
    if isinstance(data, messages.TrySeeds):
        return [child_messages.NewSeed(seed) for seed in data.seeds]
    return [
        child_messages.SetPort(node_id=data.node_id, path=data.path, port=data.port, value=value)
        for value in data.values
    ]


def _bounded(outcome: messages.TryOutcome, job: str) -> messages.TryOutcome:
    paths = {robot: points[: 2 * PATH_POINTS] for robot, points in list(outcome.paths.items())[:MOST_PATHS]}
    return structs.replace(outcome, job=job, message=outcome.message[:MOST_CHARACTERS], paths=paths)
