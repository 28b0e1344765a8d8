"""What a step of the session may wait for, and how it fails."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from executor.session.child import Child

__all__ = [
    "NOT_ANSWERING",
    "Answered",
    "Broken",
    "Ended",
    "Step",
    "StepFailed",
    "Wait",
    "answered",
    "confirmed",
    "gone",
    "is_spare_lost",
    "message_of",
    "taken",
]

NOT_ANSWERING: Final = "not_answering"
REPLY_TIMEOUT_S: Final = 5.0


class StepFailed(Exception):  # noqa: N818 - it is the outcome of a step
    """The step cannot be done; code, message and hint are for the client."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.hint = hint


@dataclass(frozen=True)
class Wait:
    """What a step waits for: until `until` returns something, or raises `StepFailed`."""

    until: Callable[[], Any]
    timeout_s: float
    too_late: str


Step = Generator[Wait, Any, None]
Broken = Generator[Wait, Any, StepFailed]
Ended = Generator[Wait, Any, StepFailed | None]
Answered = Generator[Wait, Any, dict[str, Any]]


def message_of(child: Child, *types: str) -> Callable[[], dict[str, Any] | None]:
    """Returns a condition: the child sent one of these messages; it fails if the child is gone."""

    def until() -> dict[str, Any] | None:
        for type_ in types:
            if (message := child.said(type_)) is not None:
                return message
        if not child.is_alive:
            raise StepFailed("process_died", f"The {child.kind} {child.exit_reason}.", _last_words(child))
        return None

    return until


def taken(child: Child, *types: str) -> Callable[[], dict[str, Any] | None]:
    """The same for what a child does at its start: one that does not even take that is given up at once."""
    until = message_of(child, *types)

    def taken() -> dict[str, Any] | None:
        reply = until()
        if reply is None and child.is_hanging and not child.is_in_use:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return reply

    return taken


def answered(child: Child, *types: str) -> Callable[[], dict[str, Any] | None]:
    """The same as `message_of`, but one that hangs is not waited for."""
    until = message_of(child, *types)

    def answered() -> dict[str, Any] | None:
        reply = until()
        if reply is None and child.is_hanging:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return reply

    return answered


def confirmed(ordered: tuple[Child, str], what: str, timeout_s: float = REPLY_TIMEOUT_S) -> Wait:
    """Waits until a child did what it was told by `Session.order`."""
    child, token = ordered

    def until() -> bool | None:
        answer = child.answer(token)
        if answer is not None:
            error = answer.get("error")
            if not error:
                return True
            raise StepFailed(str(error.get("code")), str(error.get("message")), str(error.get("hint", "")))
        if not child.is_alive:
            raise StepFailed("process_died", f"The {child.kind} {child.exit_reason}.", _last_words(child))
        if child.is_hanging:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return None

    return Wait(until, timeout_s, f"The {child.kind} did not {what} in time.")


def is_spare_lost(child: Child, failure: StepFailed) -> bool:
    """Whether a step failed since the process that waited for it was frozen, or died just then."""
    return not child.is_in_use and failure.code in {NOT_ANSWERING, "process_died"}


def gone(child: Child) -> Callable[[], bool | None]:
    """Returns a condition: the child has ended."""
    return lambda: None if child.is_alive else True


def _last_words(child: Child) -> str:
    return "\n".join(child.last_lines[-5:])
