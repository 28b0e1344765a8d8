"""Runs a project in lock-step under the debugger of the terminal."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, TextIO

from executor.headless.debug.prompt import Prompt
from executor.headless.lockstep import LockstepRun
from tree_gardener.debugging import Debugger, DebuggingEnded

if TYPE_CHECKING:
    from types import FrameType

    from executor.headless.guard import Guard
    from executor.headless.lockstep import LockstepOptions
    from executor.headless.report import Report
    from translator import Project
    from tree_gardener.debugging import Stop

WELCOME = "The tree is held before its first tick; the world waits too. `help` lists the commands."


class DebugRun:
    """A run whose world and tree are held while the user gives commands.

    Args:
        project: the project.
        options: options of the run.
        guard: watches for hangs; it is suspended while the tree is held.
        stdin: the commands, if they do not come from the terminal.
        stdout: for the answers.
    """

    _debugger: Debugger
    _prompt: Prompt

    def __init__(
        self,
        project: Project,
        options: LockstepOptions,
        guard: Guard,
        stdin: TextIO | None = None,
        stdout: TextIO | None = None,
    ) -> None:
        self._run = LockstepRun(project, options, lambda line: print(line, file=sys.stderr))  # noqa: T201
        self._run.moved = guard.moved
        self._guard = guard
        self._stdin, self._stdout = stdin, stdout
        self._is_hold_wanted = False

    def play(self) -> Report | None:
        """Runs the project, held before its first tick; returns its report, or None if the user quits.

        Raises:
            KeyboardInterrupt: Ctrl+C was pressed twice without reaching a node.
            the errors of `run_lockstep`.
        """
        run = self._run
        before = signal.getsignal(signal.SIGINT)
        try:
            run.set_up()
            self._debugger = Debugger(self._hold)
            run.tree.debug(self._debugger)
            self._prompt = Prompt(
                run.tree, self._debugger, lambda: run.world.time_s, self._stdin, self._stdout
            )
            self._prompt.say(WELCOME)
            self._debugger.request_hold()
            signal.signal(signal.SIGINT, self._interrupt)
            return run.play(None, None)
        except DebuggingEnded:
            return None
        finally:
            signal.signal(signal.SIGINT, before)
            run.close()

    def _hold(self, stop: Stop) -> None:
        self._is_hold_wanted = False
        with self._guard.suspended():
            self._prompt.serve(stop)

    def _interrupt(self, _number: int, _frame: FrameType | None) -> None:
        """Holds the tree at the next node; the second time without one, ends the run.

        At the prompt it clears the line.
        """
        if self._prompt.is_reading or (self._is_hold_wanted and self._debugger.held is None):
            raise KeyboardInterrupt
        self._is_hold_wanted = True
        self._debugger.request_hold()
