"""The recording of a session: its recorder, its runs, and the requests of clients to read them.

A recorder that dies or hangs is reported and replaced; the run continues.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from uuid import uuid4

from msgspec import to_builtins

from executor import child_messages, messages, recorder_messages
from executor.session.questions import answer, answer_late

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.session.events import ChildExited, ChildLooked, ChildSaid
    from executor.session.stage import Stage

__all__ = ["Recording"]

MOST_LOST: Final = 3
SILENT_S: Final = 8.0
LONGEST_LOOK_S: Final = 0.5
_TOLD: Final = (messages.Log, messages.Fault, messages.Finished)


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
        self.run = ""

    def start(self, folder: str, *, is_whole: bool = False) -> None:
        """Starts the recorder; nothing is recorded before. With `is_whole` nothing is dropped later."""
        self._folder, self._is_whole = folder, is_whole
        self._silent_s, self._looked_s = 0.0, None
        self._stage.children.ensure("recorder")
        self._stage.children.tell_recorder(recorder_messages.StartRecorder(folder, is_whole))
        if self.run:
            self._begin_run()

    @property
    def folder(self) -> str:
        """The folder of the recordings; "" if nothing is recorded."""
        return self._folder

    def begin(self, *, resets: bool = False) -> None:
        """Begins the recording of another run; with `resets` in a world that was reset just now."""
        if not self._folder:
            return
        self.run = uuid4().hex[:12]
        self._begin_run()
        message = child_messages.BeginRecording(self.run, resets)
        self._stage.children.tell_world(message)
        self._stage.children.tell_application(message)

    def tell(self, name: str, event: Struct) -> None:
        """Records an event that all clients get, if it has a place in a recording."""
        if not (self.run and isinstance(event, _TOLD)):
            return
        t_s = getattr(event, "time", 0.0) or self._stage.sim_time_s
        self._stage.children.tell_recorder(recorder_messages.Told(self.run, name, t_s, to_builtins(event)))

    def flag(self, text: str) -> bool:
        """Marks the present moment; returns whether there is a recording."""
        if not self.run or self._stage.children.get("recorder") is None:
            return False
        told = recorder_messages.Told(self.run, "flag", self._stage.sim_time_s, {"text": text})
        self._stage.children.tell_recorder(told)
        return True

    # --- the recorder -----------------------------------------------------------------------------

    def said(self, event: ChildSaid) -> None:
        """Handles a message of the recorder."""
        stage = self._stage
        if stage.children.of(event) is None:
            return
        self._silent_s = 0.0
        match event.message:
            case recorder_messages.Recorded(segment=segment):
                stage.output.emit(segment)
            case child_messages.Log(level=level, text=text):
                stage.output.emit(messages.Log("manager", level, text, time=stage.sim_time_s))
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
            self._replace(reason)

    def exited(self, event: ChildExited) -> None:
        """Replaces a recorder that has ended."""
        stage = self._stage
        child = stage.children.of(event)
        if child is None:
            return
        del stage.children.living["recorder"]
        child.end(event.reason, event.last_lines)
        answer_late(stage, stage.questions.orphaned(child.key), "process_died", event.reason)
        self._replace("\n".join([event.reason, *event.last_lines[-3:]]))

    def _replace(self, reason: str) -> None:
        self._lost += 1
        ends = self._lost > MOST_LOST
        what = "Nothing more is recorded" if ends else "Another one records from here"
        text = f"The recorder {reason}. {what}; the run continues."
        if not ends:
            self.start(self._folder, is_whole=self._is_whole)
        self._stage.output.emit(messages.Log("manager", "warning", text, time=self._stage.sim_time_s))

    def _begin_run(self) -> None:
        stage = self._stage
        about = {"universe": stage.mirror.universe, "seed": str(stage.run.seed)}
        stage.children.tell_recorder(recorder_messages.BeginRun(self.run, about, stage.run.folder))
