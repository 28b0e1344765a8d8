"""The process that follows another program's tree: `python -m executor.attached.process --channel-fd N`.

It takes the place of the application of a session, and speaks its messages. What the other program sends is
not trusted: it is bounded in time, size and depth where it is read.
"""

from __future__ import annotations

import argparse
import os
import signal
import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor import child_messages, messages
from executor.attached.control import Control, RefusedError, Wanted, explain
from executor.attached.document import document_of
from executor.attached.following import Boards, Statuses
from executor.attached.recording import AttachedRecorder
from executor.child_messages import FromApplication, ToApplication, decode_to_application
from executor.recorder.link import ADDRESS_VARIABLE
from executor.supervision.channel import Channel, ChannelClosed, ChannelError
from executor.supervision.confine import die_with_parent
from executor.supervision.pulse import Pulse
from translator.catalog import builtins
from translator.diagnostic import TranslatorError
from tree_gardener.groot import GrootError
from tree_gardener.groot.client import Groot2Client, SilenceError, read_address
from tree_gardener.groot.libraries import libraries

if TYPE_CHECKING:
    from executor.attached.document import AttachedDocument
    from executor.messages import AttachState
    from tree_gardener.groot.remote import RemoteTree

__all__ = ["Follower", "main"]

PERIOD_S: Final = 0.05
BOARD_S: Final = 0.5
TELL_S: Final = 1.0
HOOKS_S: Final = 0.5
FIRST_TRIES: Final = 3
RETRY_S: Final = 0.5
GOODBYE_S: Final = 0.5
MOST_BEHIND_S: Final = 0.5
AGAIN: Final = "The program was started again, so its tree is read again."
_HINTS: Final = {
    True: "Does the program run, and has it a Groot2Publisher at this port?",
    False: "Programs of BehaviorTree.CPP 4 with a Groot2Publisher, and exported packages, can be followed.",
}


class _Stop(Exception):  # noqa: N818 - the way out, not an error
    """Raised when the session ends this process."""


class Follower:
    """Follows one tree, from the start message on until its publisher is another one.

    Args:
        channel: leads to the session.
        pulse: tells the session that this process lives.
        recorder: the address of the session's recorder; "" for none.
    """

    def __init__(self, channel: Channel[FromApplication, ToApplication], pulse: Pulse, recorder: str) -> None:
        self._channel = channel
        self._pulse = pulse
        self._recorder_address = recorder
        self._began_s = time.monotonic()
        self._state: AttachState = "connecting"
        self._problem = ""
        self._answered_s: float | None = None
        self._told_s = 0.0
        self._boards_s = 0.0
        self._hooks_s = 0.0
        self._dropped = 0
        self._records_since_s: float | None = None

    def run(self) -> None:
        """Follows until the session ends it, or the program was started again."""
        try:
            start = self._wait_for_start()
            if start is None:
                return
            self._address = start.attach
            self._client = Groot2Client(*read_address(start.attach))
            with self._pulse.busy("loading"):
                self._channel.send(child_messages.Starting())
                tree = self._first_tree()
                if tree is None or not self._show(tree, Path(start.app_dir)):
                    return
            self._channel.send(child_messages.ApplicationReady())
            self._follow()
        except _Stop:
            pass
        finally:
            self._close()

    def _wait_for_start(self) -> child_messages.StartApplication | None:
        libraries(), builtins()  # loaded now, they are not waited for later
        self._pulse.rests()
        while True:
            self._pulse.moved()
            message = self._channel.receive(0.2)
            if isinstance(message, child_messages.Stop):
                return None
            if isinstance(message, child_messages.StartApplication):
                self._first_breakpoints = message.breakpoints
                return message

    def _first_tree(self) -> RemoteTree | None:
        self._tell("connecting")
        for left in reversed(range(FIRST_TRIES)):
            try:
                self._client.listen()
                return self._client.tree()
            except GrootError as error:
                if left and isinstance(error, SilenceError):
                    self._pulse.moved()
                    continue
                self._tell("silent", str(error))
                self._fault(str(error), _HINTS[isinstance(error, SilenceError)])
                return None
        return None

    def _show(self, tree: RemoteTree, folder: Path) -> bool:
        """Sends the tree to the session; returns False if it cannot be shown."""
        try:
            document = document_of(tree)
        except (GrootError, TranslatorError) as error:
            found = error.diagnostics[0].message if isinstance(error, TranslatorError) else str(error)
            self._tell("silent", found)
            self._fault(f"The tree of the other program cannot be shown: {found}", "")
            return False
        self._tree = tree
        self._statuses = Statuses(document.numbers)
        self._boards = Boards()
        self._control = Control(
            document.nodes, document.numbers, self._client, self._channel.send, self._statuses
        )
        self._recorder = AttachedRecorder(document.nodes, document.numbers, self._recorder_address)
        if self._first_breakpoints is not None:
            self._obey_control(child_messages.SetBreakpoints(wanted=self._first_breakpoints))
        self._write(document, folder)
        self._channel.send(_described(document, self._address))
        self._channel.send(child_messages.Tree(document.nodes))
        return True

    def _write(self, document: AttachedDocument, folder: Path) -> None:
        """Writes the diagrams where the recorder takes them from."""
        for path, data in document.files.items():
            file = folder / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(data)

    def _follow(self) -> None:
        due_s = time.monotonic()
        while True:
            self._pulse.moved()
            while (message := self._channel.receive(max(0.0, due_s - time.monotonic()))) is not None:
                self._obey(message)
            now_s = time.monotonic()
            due_s = max(due_s + PERIOD_S, now_s - MOST_BEHIND_S)
            try:
                is_same = self._look()
            except SilenceError as error:
                self._lose(str(error))
                due_s = time.monotonic() + RETRY_S
            except GrootError as error:
                self._lose(str(error))
                due_s = time.monotonic() + RETRY_S
            else:
                if not is_same:
                    self._control.lost()
                    self._channel.send(child_messages.Finished("IDLE", "process_died", AGAIN))
                    raise _Stop
            self._recorder.pump()
            if now_s - self._told_s >= TELL_S:
                self._tell(self._state, self._problem)

    def _look(self) -> bool:
        """Asks once; returns False if another publisher answers."""
        client, control = self._client, self._control
        states, dropped = client.statuses()
        if client.publisher != self._tree.id:
            return False
        is_new = client.take_cut() or self._state != "following"
        if is_new and not self._find():
            return False
        self._answered_s = time.monotonic()
        self._dropped += dropped
        now_s = self._now_s()
        tick = self._statuses.take(states, now_s)
        self._channel.send(tick)
        self._record(now_s)
        for uid in client.reached():
            control.reached(uid)
        if self._answered_s - self._boards_s >= BOARD_S:
            self._boards_s = self._answered_s
            self._look_at_boards()
        if control.is_on and self._answered_s - self._hooks_s >= HOOKS_S:
            self._hooks_s = self._answered_s
            control.refresh()
        return True

    def _look_at_boards(self) -> None:
        boards = self._client.blackboards(self._tree.scopes)
        main = self._tree.scopes[0] if self._tree.scopes else ""
        shown, rows = self._boards.take(boards, main)
        if shown:
            self._channel.send(child_messages.Blackboard(shown))
            self._recorder.written(rows, self._now_s())

    def _record(self, now_s: float) -> None:
        if self._records_since_s is None:
            return
        transitions, dropped = self._client.transitions()
        self._dropped += dropped
        self._recorder.take(transitions, self._records_since_s, self._now_s())

    def _find(self) -> bool:
        """Begins again after silence, since what the program keeps of us may be gone; False for another tree.

        Each process of BehaviorTree.CPP 4.8 has the same UUID, so the tree itself is compared.
        """
        if self._client.tree().document != self._tree.document:
            return False
        # They are set again a little later: who listens to reached hooks may not be connected again yet.
        self._control.withdraw()
        self._hooks_s = time.monotonic()
        if self._recorder.is_wanted:
            self._begin_transitions()
        self._answered_s = time.monotonic()
        self._tell("following")
        return True

    def _lose(self, why: str) -> None:
        if self._state != "silent" or self._problem != why:
            self._control.lost()
            self._tell("silent", why)

    def _begin_transitions(self) -> None:
        self._client.record(on=True)
        self._records_since_s = self._now_s()
        states, _ = self._client.statuses()
        self._recorder.correct({uid: state.status for uid, state in states.items()}, self._now_s())

    def _obey(self, message: ToApplication) -> None:
        match message:
            case child_messages.Stop():
                raise _Stop
            case child_messages.Resume():
                self._channel.send(child_messages.Resumed())
            case child_messages.Pause():
                self._channel.send(child_messages.Paused())
            case child_messages.BeginRecording():
                self._recorder.begin(message.run)
                try:
                    self._begin_transitions()
                except GrootError as error:
                    self._lose(str(error))
            case (
                child_messages.SetBreakpoints()
                | child_messages.Continue()
                | child_messages.ForceResult()
                | child_messages.ReleaseForced()
                | child_messages.Control()
            ):
                answer = self._obey_control(message)
                self._channel.send(child_messages.Answer(request=message.request, error=answer))
            case child_messages.Asked():
                refused = messages.Error("attached", "This is not possible in an attached session.")
                self._channel.send(child_messages.Answer(request=message.request, error=refused))
            case _:
                pass

    def _obey_control(self, message: Wanted) -> messages.Error | None:
        """Carries out a command; returns why it is refused, which the log says where no client waits."""
        error = self._refusal(message)
        if error is not None and message.request is None:
            self._channel.send(child_messages.Log("warning", f"{error.message} {error.hint}".strip()))
        return error

    def _refusal(self, message: Wanted) -> messages.Error | None:
        try:
            self._control.obey(message)
        except RefusedError as refused:
            return refused.error
        except GrootError as error:
            return explain(error)
        finally:
            if isinstance(message, child_messages.Control):
                self._tell(self._state, self._problem)
        return None

    def _now_s(self) -> float:
        return time.monotonic() - self._began_s

    def _tell(self, state: AttachState, problem: str = "") -> None:
        self._state, self._problem, self._told_s = state, problem, time.monotonic()
        age_s = None if self._answered_s is None else self._told_s - self._answered_s
        control = getattr(self, "_control", None)
        statuses = getattr(self, "_statuses", None)
        dropped = self._dropped + (statuses.dropped if statuses is not None else 0)
        controls = control is not None and control.is_on
        self._channel.send(child_messages.Attached(self._address, state, age_s, dropped, controls, problem))

    def _fault(self, message: str, hint: str) -> None:
        text = f"{message[:1].upper()}{message[1:]}"
        self._channel.send(child_messages.Fault("load", f"{text.rstrip('.')}.", hint=hint))

    def _close(self) -> None:
        if hasattr(self, "_control"):
            try:
                self._control.end()
                if self._records_since_s is not None:
                    self._client.record(on=False)
            except GrootError:
                pass  # it is gone, and with it what we have set
            self._recorder.close()
        if hasattr(self, "_client"):
            self._client.close()
        self._channel.flush(GOODBYE_S)


def _described(document: AttachedDocument, address: str) -> child_messages.AttachedTree:
    files = {path: data.decode() for path, data in document.files.items()}
    name = f"{document.main_tree} · {address}"
    return child_messages.AttachedTree(name, document.main_tree, files, document.actions, document.xml)


def main(arguments: list[str] | None = None) -> None:
    """Follows a program for the manager at the other end of a channel."""
    parser = argparse.ArgumentParser(prog="python -m executor.attached.process", description=__doc__)
    parser.add_argument("--channel-fd", type=int, required=True)
    options = parser.parse_args(arguments)
    die_with_parent()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the manager handles Ctrl-C
    channel: Channel[FromApplication, ToApplication] = Channel(options.channel_fd, decode_to_application)
    recorder = os.environ.pop(ADDRESS_VARIABLE, "")
    try:
        Follower(channel, Pulse(channel.send), recorder).run()
    except ChannelClosed:
        pass
    except ChannelError as error:
        os.write(2, f"The manager sent a message that cannot be read: {error}\n".encode())


if __name__ == "__main__":
    main()
