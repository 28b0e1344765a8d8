"""The recording of a session: its recorder, its runs, and the requests of clients to read them.

A recorder that dies or hangs is reported and replaced; the run continues.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from uuid import uuid4

from msgspec import structs, to_builtins

from executor import child_messages, messages, recorder_messages
from executor.session.questions import answer, answer_late
from executor.session.runs.results import RunResults

if TYPE_CHECKING:
    from collections.abc import Mapping

    from msgspec import Struct

    from executor.session.events import ChildExited, ChildLooked, ChildSaid
    from executor.session.stage import Stage

__all__ = ["MOST_FLAGS", "MOST_LOST", "FlagRefused", "Recording", "flag_of"]

MOST_LOST: Final = 3
MOST_FLAGS: Final = 200
SILENT_S: Final = 8.0
LONGEST_LOOK_S: Final = 0.5
_TOLD: Final = (
    messages.Log,
    messages.Fault,
    messages.Finished,
    messages.FlagSet,
    messages.RecordingStopped,
)


class Recording:
    """The recorder of a session, and the run that it records.

    Attributes:
        run: the name of the run; "" before the first.
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._folder = ""
        self._is_whole = False
        self._lost = 0
        self._silent_s = 0.0
        self._looked_s: float | None = None
        self._is_stopped = False
        self._branch: dict[str, str] = {}
        self._numbers: dict[str, int] = {}
        self._results = RunResults()
        self.run = ""

    def start(self, folder: str, *, is_whole: bool = False) -> None:
        """Starts the recorder; nothing is recorded before. With `is_whole` nothing is dropped later."""
        self._folder, self._is_whole = folder, is_whole
        self._silent_s, self._looked_s = 0.0, None
        self._stage.children.ensure("recorder")
        self._stage.children.tell_recorder(recorder_messages.StartRecorder(folder, is_whole))
        if self.run:
            self._begin_run()
            self._tell_flags()

    @property
    def folder(self) -> str:
        """The folder of the recordings; "" if nothing is recorded."""
        return self._folder

    def begin(self, *, resets: bool = False, parent: str = "", from_t: float = 0.0) -> None:
        """Begins the recording of another run; with `resets` in a world that was reset just now.

        A branch has a `parent`, the run that it continues from the moment `from_t` in s.
        """
        if not self._folder:
            return
        if self.run and not parent and self._results.stop(self.run):
            self._tell_result(self.run)
        self.run, self._is_stopped = uuid4().hex[:12], False
        self._numbers[self.run] = len(self._numbers) + 1
        self._branch = {"parent": parent, "from_t": repr(from_t)} if parent else {}
        if parent:
            self._stage.output.emit(messages.Branch(self.run, parent, from_t))
        self._begin_run()
        message = child_messages.BeginRecording(self.run, resets)
        self._stage.children.tell_world(message)
        self._stage.children.tell_application(message)

    def change_files(self, folder: str) -> None:
        """Records the project's files of another folder, from which the next tree is made."""
        if self.run:
            self._stage.children.tell_recorder(recorder_messages.ChangeFiles(self.run, folder))

    def tell(self, name: str, event: Struct) -> None:
        """Records an event that all clients get, if it has a place in a recording."""
        if self.run and self._results.hear(self.run, event):
            self._tell_result(self.run)
        if not (self.run and isinstance(event, _TOLD)):
            return
        t_s = getattr(event, "time", 0.0) or self._stage.sim_time_s
        message = recorder_messages.RunEvent(self.run, name, t_s, to_builtins(event))
        self._stage.children.tell_recorder(message)

    def flag(self, wanted: messages.Flag, user: str | None = None) -> None:
        """Sets, changes or removes a flag of the present run; `user` is who the client is, if that is known.

        Raises:
            FlagRefused: it cannot be kept, or is not there.
        """
        if not self.run or self._stage.children.get("recorder") is None or self._is_stopped:
            hint = "Press Run first." if not self.run else "Press Run again: the next run is recorded."
            raise FlagRefused("not_recorded", "There is no recording to mark.", hint)
        stage = self._stage
        known = {flag.id: flag for flag in stage.mirror.flags.values() if flag.run == self.run}
        stage.output.emit(flag_of(wanted, known, self.run, stage.sim_time_s, user))

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the recorder."""
        stage = self._stage
        child = stage.children.of(event)
        if child is None:
            return
        self._silent_s = 0.0
        match event.message:
            case recorder_messages.Recorded(segment=segment):
                number, result = self._numbers.get(segment.run, 0), self._results.of(segment.run)
                stage.output.emit(structs.replace(segment, run_number=number, result=result))
            case recorder_messages.Stopped(run=run, t=t_s, reason=reason, detail=detail):
                self._is_stopped = self._is_stopped or run == self.run
                stage.output.emit(messages.RecordingStopped(run, t_s, reason, detail, goes_on=False))
                text = f"The recording stops here: {detail}. The run continues."
                stage.output.emit(messages.Log("manager", "warning", text, time=t_s))
            case child_messages.Log(level=level, text=text):
                stage.output.emit(messages.Log("manager", level, text, time=stage.sim_time_s))
            case recorder_messages.WorldKeyframe() as found:
                child.note(found)
            case child_messages.Answer() as reply if child.take_answer(reply):
                pass  # the session itself asked
            case child_messages.Answer(request=request, error=error) if request is not None:
                question = stage.questions.answered(request)
                if question is not None:
                    answer(stage, question, error)
            case _:
                pass

    def looked(self, event: ChildLooked, now_s: float) -> None:
        """Ends a recorder that has not sent a sign of life for long, while this process was awake."""
        if self._stage.children.of(event) is None:
            return
        passed_s = 0.0 if self._looked_s is None else now_s - self._looked_s
        self._looked_s = now_s
        self._silent_s += min(passed_s, LONGEST_LOOK_S)
        if self._silent_s >= SILENT_S:
            reason = f"was ended: it did not answer for {SILENT_S:g} s"
            self._stage.children.drop("recorder", reason=reason)
            self._replace("recorder_hung", reason)

    def exited(self, event: ChildExited) -> None:
        """Replaces a recorder that has ended."""
        stage = self._stage
        child = stage.children.of(event)
        if child is None:
            return
        del stage.children.living["recorder"]
        child.end(event.reason, event.last_lines)
        answer_late(stage, stage.questions.orphaned(child.key), "process_died", event.reason)
        self._replace("recorder_died", "\n".join([event.reason, *event.last_lines[-3:]]))

    def _replace(self, reason: messages.StopReason, detail: str) -> None:
        self._lost += 1
        ends = self._lost > MOST_LOST
        what = "Nothing more is recorded" if ends else "Another one records from here"
        text = f"The recorder {detail}. {what}; the run continues."
        t_s = self._stage.sim_time_s
        if not ends:
            self.start(self._folder, is_whole=self._is_whole)
        if self.run:
            cause = f"The recorder {detail}."
            stop = messages.RecordingStopped(self.run, t_s, reason, cause, goes_on=not ends)
            self._stage.output.emit(stop)
        self._stage.output.emit(messages.Log("manager", "warning", text, time=t_s))

    def _tell_result(self, run: str) -> None:
        """Sends the newest segment of a run again: nothing more may be recorded of it."""
        known = [segment for segment in self._stage.mirror.segments.values() if segment.run == run]
        if known:
            self._stage.output.emit(structs.replace(known[-1], result=self._results.of(run)))

    def _tell_flags(self) -> None:
        """Sends another recorder the flags of the run: a part of it may go with the segments before."""
        for flag in self._stage.mirror.flags.values():
            if flag.run == self.run:
                self.tell("flag", flag)

    def _begin_run(self) -> None:
        stage = self._stage
        launched = stage.run.universe
        about = {"universe": stage.mirror.universe, "seed": str(stage.run.seed), **self._branch}
        about["robot"] = (launched.robot if launched is not None else None) or ""
        if (application := stage.run.application) is not None and application.revision is not None:
            about["revision"] = str(application.revision)
        universe = launched.universe if launched is not None else ""
        document = universe.document if isinstance(universe, messages.UniverseDocument) else ""
        begin = recorder_messages.BeginRun(self.run, about, stage.run.folder, document)
        stage.children.tell_recorder(begin)


class FlagRefused(Exception):  # noqa: N818 - an answer to a client
    """A flag is not set: a code, a sentence, and what can be done."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.code, self.message, self.hint = code, message, hint


def flag_of(
    wanted: messages.Flag,
    known: Mapping[str, messages.FlagSet],
    run: str,
    now_s: float,
    user: str | None = None,
) -> messages.FlagSet:
    """Returns a flag as a client wants it.

    Args:
        wanted: what the client sent.
        known: the flags of the run, by id.
        run: the present run.
        now_s: the present moment in s; no flag is later.
        user: who the client is; with None the flag has the name that the client gave.

    Raises:
        FlagRefused: the flag does not exist, has no text, is of another run, or is one too many.
    """
    if wanted.run not in ("", run):
        raise FlagRefused(
            "not_present", "Another run has begun meanwhile.", "Flags are set in the present run only."
        )
    old = known.get(wanted.id) if wanted.id else None
    if wanted.id and old is None:
        raise FlagRefused("unknown_flag", "This flag is not there any more.")
    text = wanted.text.strip()
    if old is None and not text:
        raise FlagRefused("no_text", "The flag has no text.", "Say in a few words what is to be seen here.")
    if old is None and len(known) >= MOST_FLAGS:
        hint = "Remove one that is not needed any more."
        raise FlagRefused("too_many", f"A run has at most {MOST_FLAGS} flags.", hint)
    t_s = wanted.t if wanted.t is not None else (old.t if old is not None else now_s)
    if user is None:
        user = wanted.user if wanted.user or old is None else old.user
    return messages.FlagSet(run, old.id if old is not None else uuid4().hex[:12], min(t_s, now_s), text, user)
