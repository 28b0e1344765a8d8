"""Handles the end of a child process.

The ladder goes down to the highest state that is possible without it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor import messages
from executor.child_messages import Finished
from executor.session.exact import hosting
from executor.session.ladder import HAS_APPLICATION, State
from executor.session.questions import answer_late
from executor.session.running import stop_moving

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.events import ChildExited
    from executor.session.stage import Stage

__all__ = ["exited", "lose"]


def exited(stage: Stage, event: ChildExited) -> None:
    """Handles the exit of a world or an application, whether it was expected or not."""
    child = stage.children.of(event)
    if child is None:
        return
    del stage.children.living[event.kind]
    child.end(event.reason, event.last_lines)
    hosting.give_back(stage, child)
    answer_late(stage, stage.questions.orphaned(child.key), "process_died", event.reason)
    if child.is_stopping:
        _stopped(stage)
        return
    if child.said(Finished) is not None:
        return  # the step that begins the run says so, when it comes to its end
    what = "The simulated world" if event.kind == "world" else "The application"
    message = f"{what} {event.reason}."
    lines = "\n".join(event.last_lines)
    if not child.is_in_use:
        text = f"{message} It was not in use yet. {lines}".strip()
        stage.output.emit(messages.Log("manager", "warning", text))
        return
    stage.output.emit(
        messages.Fault("process", message, hint="Press Run to start it again.", traceback=lines)
    )
    _fall(stage, child, message)


def lose(stage: Stage, child: Child, reason: str, message: str) -> None:
    """Ends a child that is in use, and enters the highest state that is possible without it."""
    stage.children.drop(child.kind, reason=reason)
    _fall(stage, child, message)


def _stopped(stage: Stage) -> None:
    """Handles the exit of an application that had received `Stop`."""
    if stage.state in HAS_APPLICATION:
        stage.output.emit(messages.Finished("IDLE", "terminated"))
        stage.enter(State.VISUALIZATION_READY)
        stage.children.replenish()


def _fall(stage: Stage, child: Child, message: str) -> None:
    """Enters the highest state that is possible without the child."""
    rung = State.CONNECTED if child.kind == "world" else State.VISUALIZATION_READY
    if stage.state.height <= rung.height:
        return
    if stage.state in HAS_APPLICATION:
        stage.output.emit(messages.Finished("IDLE", "process_died", message))
    if child.kind == "world":
        stage.run.universe = None
        stage.children.drop("application", reason="was ended, since the simulated world is gone")
    else:
        stop_moving(stage)
    stage.enter(rung, message)
    stage.children.replenish()
