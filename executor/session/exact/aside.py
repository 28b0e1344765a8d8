"""A process beside the ladder that makes a run again up to a moment, out of sight.

It begins as a copy of the newest snapshot before the moment, or in a fresh process from the begin of the run;
a copy that ends before it is there is followed by such a process. The world of the session takes no notice.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from msgspec import structs

from executor import child_messages
from executor.session.events import DropSnapshot
from executor.session.exact.going_back import LIVE_HINT, found_run, refuse_by_hand
from executor.session.exact.snapshots import ticks_of
from executor.session.waits import StepFailed

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.replay_messages import Replay
    from executor.session.events import ChildExited, ChildSaid, CommandCame, Kind
    from executor.session.exact.past import PastRun
    from executor.session.stage import Stage

__all__ = ["LATE", "SILENT_S", "Aside"]

SILENT_S: Final = 60.0
"""A process that makes no progress for so long is ended."""
LAST_LINES: Final = 3
LATE: Final = "The run could not be made again in time: it no longer makes progress."


@dataclass
class _Work:
    past: PastRun
    replay: Replay
    heard_s: float
    is_woken: bool = False
    is_there: bool = False


class Aside:
    """One such process at a time.

    Args:
        stage: the session.
        kind: the kind of its child.
    """

    def __init__(self, stage: Stage, kind: Kind) -> None:
        self._stage = stage
        self._kind: Kind = kind
        self._work: _Work | None = None

    @property
    def is_there(self) -> bool:
        """Whether the run is at the moment."""
        return self._work is not None and self._work.is_there

    def found(self, event: CommandCame, run: str, until_s: float | None, live: str) -> PastRun | None:
        """Returns the run of a command, or refuses the command; `live` is the text for a live run."""
        try:
            past = found_run(self._stage, run)
            if not past.is_exact:
                raise StepFailed("live_run", live, LIVE_HINT)
            refuse_by_hand(past, until_s)
        except StepFailed as failure:
            self._stage.output.refuse(event, failure.code, failure.message, failure.hint)
            return None
        return past

    def begin(self, past: PastRun, replay: Replay, after_s: float | None) -> None:
        """Begins to make the run again; no snapshot that is later than `after_s` is used."""
        self._work = work = _Work(past, replay, self._stage.now_s)
        snapshot = self._stage.snapshots.newest(past, after_s, ticks_of(replay))
        if snapshot is None:
            self._make_again(work)
            return
        work.is_woken = True
        child = self._stage.children.wake(snapshot, self._kind)
        self._stage.children.tell_exact(child, child_messages.Awake(replay, 0.0))
        self._stage.children.tell_exact(child, child_messages.KeepSnapshots(is_on=False))

    def end(self) -> None:
        """Ends the process, if there is one."""
        self._work = None
        self._stage.children.drop(self._kind)

    def heard(self) -> None:
        """Notes that the process makes progress."""
        if self._work is not None:
            self._work.heard_s = self._stage.now_s

    def said(self, event: ChildSaid) -> Struct | None:
        """Returns what the process says; None if it is of no interest, or of an earlier one."""
        message, work = event.message, self._work
        if isinstance(message, child_messages.SnapshotTaken):
            self._stage.output.effect(DropSnapshot(event.number, message.number))
            return None
        if self._stage.children.of(event) is None or work is None:
            return None
        if isinstance(message, child_messages.GoingBack):
            self.heard()
        elif isinstance(message, child_messages.ApplicationReady):
            if work.is_there:
                return None
            work.is_there = True
            self.heard()
        return message

    def tell(self, message: child_messages.ToExact) -> None:
        """Sends a message to the process."""
        if (child := self._stage.children.get(self._kind)) is not None:
            self._stage.children.tell_exact(child, message)

    def exited(self, event: ChildExited) -> str:
        """Notes that the process has ended; returns why its work has failed, "" if it has not."""
        child, work = self._stage.children.of(event), self._work
        if child is None:
            return ""
        del self._stage.children.living[self._kind]
        child.end(event.reason, event.last_lines)
        if work is not None and work.is_woken and not work.is_there:
            work.is_woken = False  # the snapshot is of no use
            self._make_again(work)
            return ""
        return "\n".join([f"Its process {event.reason}.", *event.last_lines[-LAST_LINES:]])

    def is_silent(self, now_s: float) -> bool:
        """Whether the process makes no progress."""
        return self._work is not None and now_s - self._work.heard_s > SILENT_S

    def _make_again(self, work: _Work) -> None:
        """Makes the run again from its begin, in a fresh process."""
        start = work.past.start
        assert start.world is not None  # noqa: S101 - an exact run has one
        work.heard_s = self._stage.now_s
        child = self._stage.children.ensure(self._kind)
        child.is_started = True
        self._stage.children.tell_exact(
            child,
            structs.replace(
                start,
                replay=work.replay,
                is_debugged=False,
                groot2=0,
                profile=None,
                world=structs.replace(start.world, speed=0.0),
            ),
        )
