"""*Try many*: a run of the session continues from a moment under several values or seeds, beside the ladder.

A process of its own makes the run again up to the moment, from the newest snapshot before it or from its
begin, and continues it once with each value in a copy of itself. The world of the session takes no notice.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor import child_messages, messages
from executor.session.events import DropSnapshot
from executor.session.exact.going_back import found_run
from executor.session.waits import StepFailed
from executor.trying_events import MOST_OUTLINES, PATH_POINTS

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.replay_messages import Replay
    from executor.session.child import Child
    from executor.session.events import ChildExited, ChildSaid, CommandCame
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage
    from executor.trying_events import TryingEnd

__all__ = ["SILENT_S", "Trying"]

SILENT_S: Final = 60.0
"""A process that makes no progress for so long is ended."""
LAST_LINES: Final = 3
MOST_CHARACTERS: Final = 2000
MOST_PATHS: Final = 8
LIVE: Final = "A live run cannot be continued from a moment: its world and its program are not one."
LIVE_HINT: Final = "Make the run exact in the menu beside Run, and press Run."
LATE: Final = "The run could not be made again in time: it no longer makes progress."


@dataclass
class _Job:
    """A job, and who hears of it."""

    data: messages.TryValues | messages.TrySeeds
    changes: list[child_messages.SetPort | child_messages.NewSeed]
    client: str
    request: str
    past: PastRun
    replay: Replay
    heard_s: float
    is_woken: bool = False
    is_there: bool = False
    done: set[int] = field(default_factory=set)


class Trying:
    """The continuations of a session: one job at a time."""

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._job: _Job | None = None

    def begin(self, event: CommandCame, data: messages.TryValues | messages.TrySeeds) -> None:
        """Begins a job; another one that runs is ended."""
        try:
            past = found_run(self._stage, data.run)
        except StepFailed as failure:
            self._stage.output.refuse(event, failure.code, failure.message, failure.hint)
            return
        if not past.is_exact:
            self._stage.output.refuse(event, "live_run", LIVE, LIVE_HINT)
            return
        self.stop()
        self._stage.output.send(event.client, messages.Ack(), event.request)
        replay = past.replay(data.t)
        self._job = job = _Job(
            data, _changes(data), event.client, event.request, past, replay, self._stage.now_s
        )
        snapshot = self._stage.snapshots.newest(past, replay.until_s)
        if snapshot is None:
            self._make_again(job)
            return
        job.is_woken = True
        child = self._stage.children.wake(snapshot, "trying")
        self._stage.children.tell_exact(child, child_messages.Awake(replay, 0.0))
        self._stage.children.tell_exact(child, child_messages.KeepSnapshots(is_on=False))

    def stop(self, name: str = "") -> None:
        """Ends the job, if it has this name; "" is any."""
        if self._job is not None and name in ("", self._job.data.job):
            self._end("cancelled")

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the process."""
        child, job = self._stage.children.of(event), self._job
        message = event.message
        if isinstance(message, child_messages.SnapshotTaken):
            self._stage.output.effect(DropSnapshot(event.number, message.number))
        if child is None or job is None:
            return
        match message:
            case child_messages.GoingBack(fraction=fraction):
                job.heard_s = self._stage.now_s
                self._tell(job, messages.TryingProgress(job.data.job, "going_back", fraction))
            case child_messages.ApplicationReady() if not job.is_there:
                job.is_there, job.heard_s = True, self._stage.now_s
                order = child_messages.TryMany(job.data.job, job.changes, job.data.duration_s)
                self._stage.children.tell_exact(child, order)
            case child_messages.Fault(kind="load"):
                self._end("failed", f"{message.message} {message.hint}".strip())
            case _ if job.is_there:
                self._continued(job, message)
            case _:
                pass

    def exited(self, event: ChildExited) -> None:
        """Notes that the process has ended; without its last word it has failed."""
        child, job = self._stage.children.of(event), self._job
        if child is None:
            return
        del self._stage.children.living["trying"]
        child.end(event.reason, event.last_lines)
        if job is not None and job.is_woken and not job.is_there:
            job.is_woken = False  # the snapshot is of no use
            self._make_again(job)
            return
        self._end("failed", "\n".join([f"Its process {event.reason}.", *event.last_lines[-LAST_LINES:]]))

    def looked(self, now_s: float) -> None:
        """Ends a job whose process makes no progress."""
        if self._job is not None and now_s - self._job.heard_s > SILENT_S:
            self._end("failed", LATE)

    # --- inside ---

    def _make_again(self, job: _Job) -> None:
        """Makes the run again from its begin, in a fresh process."""
        start = job.past.start
        assert start.world is not None  # noqa: S101 - an exact run has one
        job.heard_s = self._stage.now_s
        child: Child = self._stage.children.ensure("trying")
        child.is_started = True
        self._stage.children.tell_exact(
            child,
            structs.replace(
                start,
                replay=job.replay,
                is_debugged=False,
                groot2=0,
                profile=None,
                world=structs.replace(start.world, speed=0.0),
            ),
        )

    def _continued(self, job: _Job, message: Struct) -> None:
        """Handles what the process says of the continuations; users' code runs in it."""
        name = job.data.job
        match message:
            case child_messages.TryingProgress(fraction=fraction):
                job.heard_s = self._stage.now_s
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
        self._stage.children.drop("trying")
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
