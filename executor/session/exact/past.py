"""Keeps what a run had from outside: enough to make an exact one again, up to any moment.

Of a live run it keeps its program: the state of its world is in the recording.

It is kept here, not in the run, since a run may die of what it does.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import takewhile
from typing import TYPE_CHECKING, Final

import msgspec

from executor import child_messages
from executor.child_messages import decode_to_exact
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from executor.run_inputs import input_of

if TYPE_CHECKING:
    from executor.child_messages import Differs, Entered, Fingerprints, StartApplication, WentBack
    from executor.replay_messages import Input

    Said = Entered | Fingerprints | Differs | WentBack

__all__ = ["MOST_FOLDERS", "MOST_INPUT_BYTES", "MOST_RUNS", "PastRun", "PastRuns"]

MOST_RUNS: Final = 8
MOST_FOLDERS: Final = 8
MOST_INPUT_BYTES: Final = 32 << 20
OWN_BYTES: Final = 256
"""The memory that an input takes beside its message, about."""
MOST_TICKS: Final = 2_000_000
_OF_HOLDS: Final = (child_messages.SetBreakpoints, child_messages.Continue)
TOO_MUCH: Final = "More was done by hand in this run than is kept"
TOO_MANY_CHANGES: Final = f"The tree of this run was changed more than {MOST_FOLDERS - 1} times"
DAMAGED: Final = "What this run had from outside cannot be read"
TOO_LONG: Final = "This run is too long"


@dataclass
class PastRun:
    """One run.

    Attributes:
        start: the message with which it was started.
        run: its name in the recordings; "" if it is not recorded.
        inputs: what came from outside, in order.
        fingerprints: those of its ticks.
        resets: how often its world was reset.
        refusal: why it cannot be made again, as the begin of a sentence; "" if it can.
        folders: the folders with the programs that it used.
        by_hand_s: when the debugger has changed its program by hand, in s; None if it has not.
        by_hand_ticks: the number of ticks that had ended before.
        reset_ticks: the number of ticks that had ended when its world was reset last.
        parent: the name of the run that it continues; "" if it is no branch.
        changes: when a live run got another program, in s, and the folder of that.
    """

    start: StartApplication
    run: str = ""
    inputs: list[Input] = field(default_factory=list)
    fingerprints: bytearray = field(default_factory=bytearray)
    resets: int = 0
    refusal: str = ""
    folders: tuple[str, ...] = ()
    changes: tuple[tuple[float, str], ...] = ()
    by_hand_s: float | None = None
    by_hand_ticks: int = 0
    reset_ticks: int = 0
    parent: str = ""
    input_bytes: int = 0
    has_begun: bool = False

    @property
    def is_exact(self) -> bool:
        """Whether it can be made again."""
        return self.start.world is not None

    def folder_at(self, t_s: float) -> str:
        """Returns the folder of the program that a live run had at a moment in s."""
        return next((folder for at_s, folder in reversed(self.changes) if at_s <= t_s), self.start.app_dir)

    @property
    def ticks(self) -> int:
        """The number of its ticks that have ended, as far as it has told them."""
        return len(self.fingerprints) // FINGERPRINT_BYTES

    def replay(self, until_s: float | None, ticks: int | None = None) -> Replay:
        """Returns how it is made again up to a moment in s, and at most so many ticks; with None, to its end.

        No tick is made again in which, or after which, the program was changed by hand.
        """
        most = self.ticks if ticks is None else ticks
        if self.by_hand_s is not None:
            most = min(most, self.by_hand_ticks)
        prints = bytes(self.fingerprints[: most * FINGERPRINT_BYTES])
        return Replay(list(self.inputs), prints, until_s, self.resets)

    def is_part_of(self, parent: PastRun, ticks: int) -> bool:
        """Returns whether this branch is as its parent was, in its first ticks.

        At what the debugger holds does not count.
        """
        prints = self.fingerprints[: ticks * FINGERPRINT_BYTES]
        if self.by_hand_s is not None or not parent.fingerprints.startswith(prints):
            return False
        pairs = zip(self.inputs, parent.inputs, strict=False)
        at = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], pairs))  # most need no second look
        own, others = _effective(self.inputs[at:]), _effective(parent.inputs[at:])
        return others[: len(own)] == own and all(each.tick >= ticks for each in others[len(own) :])

    def enter(self, entered: Entered) -> None:
        """Takes something that came from outside."""
        if self.refusal:
            return
        self.inputs.append(entered.input)
        self.input_bytes += len(entered.input.message) + OWN_BYTES
        if self.input_bytes > MOST_INPUT_BYTES:
            self._give_up(TOO_MUCH)
            return
        try:
            command = input_of(decode_to_exact(entered.input.message))
        except msgspec.MsgspecError:  # users' code runs in the process that sent it
            self._give_up(DAMAGED)
            return
        if isinstance(command, child_messages.Reset):
            self.resets += 1
            self.reset_ticks = entered.input.tick
        elif isinstance(command, child_messages.ApplyApplication):
            self.folders += (command.app_dir,)
            if len(self.folders) > MOST_FOLDERS:
                self._give_up(TOO_MANY_CHANGES)

    def tick(self, told: Fingerprints) -> None:
        """Takes the fingerprints of more ticks."""
        self.fingerprints += told.data
        if len(self.fingerprints) > MOST_TICKS * FINGERPRINT_BYTES:
            self._give_up(TOO_LONG)

    def until(self, reached: WentBack) -> PastRun:
        """Returns the run as it was at a moment at which another branch begins.

        That is never later than a change by hand.
        """
        return replace(
            self,
            inputs=self.inputs[: reached.inputs],
            fingerprints=self.fingerprints[: reached.ticks * FINGERPRINT_BYTES],
            resets=reached.resets,
            by_hand_s=None,
            by_hand_ticks=0,
        )

    def copy(self) -> PastRun:
        """Returns a copy that continues by itself."""
        return replace(self, inputs=list(self.inputs), fingerprints=bytearray(self.fingerprints))

    def _give_up(self, refusal: str) -> None:
        self.refusal = refusal
        self.inputs, self.fingerprints, self.folders = [], bytearray(), ()


def _effective(inputs: list[Input]) -> list[Input]:
    """Returns the inputs that change more than where the debugger holds."""
    return [each for each in inputs if not isinstance(decode_to_exact(each.message), _OF_HOLDS)]


class PastRuns:
    """The last runs in the present world, the newest last; the newest is the present one."""

    def __init__(self) -> None:
        self._runs: list[PastRun] = []

    def begin(self, start: StartApplication) -> None:
        """Adds a run that was started."""
        self._add(PastRun(start, folders=(start.app_dir,)))

    def name(self, run: str) -> None:
        """Gives the present run the name of its recording."""
        if self._runs:
            self._runs[-1].run, self._runs[-1].has_begun = run, True

    def reset(self, run: str) -> None:
        """Begins another recording of the present run, whose world was reset.

        Of a program that was changed by hand before, all of it is later.
        """
        if self._runs:
            begun = replace(self._runs[-1].copy(), run=run, parent="")
            self._add(begun if begun.by_hand_s is None else replace(begun, by_hand_s=0.0))

    def branch(self, run: PastRun, reached: WentBack, instead_of: str = "") -> None:
        """Adds a run that continues another one from a moment; it may take the place of a third."""
        if instead_of:
            self.drop(instead_of)
        self._add(replace(run.until(reached), run="", parent=run.run))

    def changed(self, t_s: float, folder: str) -> None:
        """Notes that a live present run has another program; an exact one says so itself."""
        if self._runs and not ((run := self._runs[-1]).is_exact or run.refusal):
            run.changes += ((t_s, folder),)
            run.folders += (folder,)
            if len(run.folders) > MOST_FOLDERS:
                run.refusal, run.folders, run.changes = TOO_MANY_CHANGES, (), ()

    def changed_by_hand(self, t_s: float, ticks: int) -> bool:
        """Notes that the debugger has changed the program of the present run, after so many whole ticks.

        Returns:
            whether it is the first change of this run.
        """
        if not self._runs or (run := self._runs[-1]).by_hand_s is not None:
            return False
        run.by_hand_s, run.by_hand_ticks = t_s, ticks
        return True

    def counted_by_hand(self, ticks: int) -> None:
        """Notes that more ticks of the present run were whole before its first change by hand."""
        if self._runs and (run := self._runs[-1]).by_hand_s is not None:
            run.by_hand_ticks = max(run.by_hand_ticks, ticks)

    def forget(self) -> None:
        """Forgets all runs: the world in which they were is gone."""
        self._runs.clear()

    def drop_unborn(self) -> None:
        """Forgets a run that did not begin."""
        if self._runs and not self._runs[-1].has_begun:
            del self._runs[-1]

    def drop(self, run: str) -> None:
        """Forgets a run that is thrown away."""
        self._runs = [each for each in self._runs if each.run != run]

    def find(self, run: str) -> PastRun | None:
        """Returns a run by its name, the present or last one for ""; None if it is not known."""
        if not run:
            return self._runs[-1] if self._runs else None
        return next((each for each in reversed(self._runs) if each.run == run), None)

    def said(self, message: Said) -> None:
        """Takes what the present run says about itself."""
        if not self._runs:
            return
        if isinstance(message, child_messages.Entered):
            self._runs[-1].enter(message)
        elif isinstance(message, child_messages.Fingerprints):
            self._runs[-1].tick(message)

    @property
    def names(self) -> list[str]:
        """The names of the recorded runs in which one can go back, the newest last."""
        return [run.run for run in self._runs if run.run and not run.refusal]

    @property
    def live_names(self) -> list[str]:
        """Those of them that are live: only their world goes back."""
        return [run.run for run in self._runs if run.run and not run.refusal and not run.is_exact]

    @property
    def by_hand(self) -> dict[str, float]:
        """When exact ones were changed by hand, in s: one can go back only to a moment before."""
        return {
            run.run: run.by_hand_s
            for run in self._runs
            if run.run and not run.refusal and run.is_exact and run.by_hand_s is not None
        }

    @property
    def folders(self) -> frozenset[str]:
        """The folders that are needed to make these runs again."""
        return frozenset(folder for run in self._runs for folder in run.folders)

    def _add(self, run: PastRun) -> None:
        self._runs.append(run)
        while len(self._runs) > MOST_RUNS or (len(self._runs) > 1 and len(self.folders) > MOST_FOLDERS):
            del self._runs[0]
