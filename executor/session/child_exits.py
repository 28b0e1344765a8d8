"""What the end of a child process means for the session: the ladder goes down to what is still true."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor import messages
from executor.session import steps
from executor.session.ladder import HAS_APPLICATION, State

if TYPE_CHECKING:
    from executor.session.child import Child
    from executor.session.events import ChildExited
    from executor.session.protocol import Session

__all__ = ["exited", "lose"]


def exited(session: Session, event: ChildExited) -> None:
    """A process has ended: of its own, or because it was told to."""
    session.leaving.discard((event.kind, event.number))
    if event.kind == "node":
        session.nodes.exited(session, event)
        return
    child = session.children.get(event.kind)
    if child is None or child.number != event.number:
        return
    del session.children[event.kind]
    child.end(event.reason, event.last_lines)
    session.answer_late(session.questions.orphaned((event.kind, event.number)), "process_died", event.reason)
    if child.is_stopping:
        _stopped(session)
        return
    what = "The simulated world" if event.kind == "world" else "The application"
    message = f"{what} {event.reason}."
    lines = "\n".join(event.last_lines)
    if not child.is_in_use:
        text = f"{message} It was not in use yet. {lines}".strip()
        session.emit(messages.Log("manager", "warning", text))
        return
    session.emit(messages.Fault("process", message, hint="Press Run to start it again.", traceback=lines))
    _fall(session, child, message)


def lose(session: Session, child: Child, reason: str, message: str) -> None:
    """Ends a child that is in use, and goes down to what is true without it."""
    session.drop(child.kind, reason=reason)
    _fall(session, child, message)


def _stopped(session: Session) -> None:
    """The application ended because it was told to."""
    if session.state in HAS_APPLICATION:
        session.emit(messages.Finished("IDLE", "terminated"))
        session.enter(State.VISUALIZATION_READY)
        session.replenish()


def _fall(session: Session, child: Child, message: str) -> None:
    """Goes down to the rung that is still true without the child."""
    rung = State.CONNECTED if child.kind == "world" else State.VISUALIZATION_READY
    if session.state.height <= rung.height:
        return
    if session.state in HAS_APPLICATION:
        session.emit(messages.Finished("IDLE", "process_died", message))
    if child.kind == "world":
        session.run.universe = None
        session.drop("application", reason="was ended, since the simulated world is gone")
    else:
        steps.stop_moving(session)
    session.enter(rung, message)
    session.replenish()
