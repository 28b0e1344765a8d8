"""Conditions that a step of the session waits for, and its failures."""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeVar

from msgspec import Struct

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
    """A step failed; code, message and hint are sent to the client."""

    def __init__(self, code: str, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.hint = hint


@dataclass(frozen=True)
class Wait:
    """A condition that a step waits for.

    It is met when `until` returns a value, and fails when `until` raises `StepFailed`.
    """

    until: Callable[[], Any]
    timeout_s: float
    too_late: str


Message = TypeVar("Message", bound=Struct)
Step = Generator[Wait, Any, None]
Broken = Generator[Wait, Any, StepFailed]
Ended = Generator[Wait, Any, StepFailed | None]
Answered = Generator[Wait, Any, Message]


def message_of(child: Child, *kinds: type[Message]) -> Callable[[], Message | None]:
    """Returns the condition that the child has sent one of these messages.

    It fails if the child has ended.
    """

    def until() -> Message | None:
        for kind in kinds:
            if (message := child.said(kind)) is not None:
                return message
        if not child.is_alive:
            raise StepFailed("process_died", f"The {child.kind} {child.exit_reason}.", _last_words(child))
        return None

    return until


def taken(child: Child, *kinds: type[Message]) -> Callable[[], Message | None]:
    """Returns the same condition as `message_of` for the start of a child.

    It fails immediately if the spare hangs.
    """
    until = message_of(child, *kinds)

    def taken() -> Message | None:
        reply = until()
        if reply is None and child.is_hanging and not child.is_in_use:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return reply

    return taken


def answered(child: Child, *kinds: type[Message]) -> Callable[[], Message | None]:
    """Returns the same condition as `message_of`, but it fails if the child hangs."""
    until = message_of(child, *kinds)

    def answered() -> Message | None:
        reply = until()
        if reply is None and child.is_hanging:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return reply

    return answered


def confirmed(ordered: tuple[Child, str], what: str, timeout_s: float = REPLY_TIMEOUT_S) -> Wait:
    """Returns a wait for the answer to a request that `Children.order` sent."""
    child, token = ordered

    def until() -> bool | None:
        answer = child.answer(token)
        if answer is not None:
            if answer.error is None:
                return True
            raise StepFailed(answer.error.code, answer.error.message, answer.error.hint)
        if not child.is_alive:
            raise StepFailed("process_died", f"The {child.kind} {child.exit_reason}.", _last_words(child))
        if child.is_hanging:
            raise StepFailed(NOT_ANSWERING, child.hang)
        return None

    return Wait(until, timeout_s, f"The {child.kind} did not {what} in time.")


def is_spare_lost(child: Child, failure: StepFailed) -> bool:
    """Returns whether a step failed because the spare that it used was frozen, or died at that moment."""
    return not child.is_in_use and failure.code in {NOT_ANSWERING, "process_died"}


def gone(child: Child) -> Callable[[], bool | None]:
    """Returns the condition that the child has ended."""
    return lambda: None if child.is_alive else True


def _last_words(child: Child) -> str:
    return "\n".join(child.last_lines[-5:])
