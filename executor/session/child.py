"""What the session knows of one child process, from what it said."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor.session.vitals import Vitals

if TYPE_CHECKING:
    from executor.session.events import Kind

__all__ = ["Child"]

_TASKS: Final = {"starting": "loading", "ready": ""}
"""What a child does from a message of it on."""


class Child:
    """A world or an application process.

    A child is spawned ahead of its use; it counts from the `start` that it was told, and is in use once it
    has taken that: until then none of the user's code is in it, and another one can stand in for it.

    Attributes:
        hang: what people were told of it, while it hangs.
    """

    def __init__(self, kind: Kind, number: int, now_s: float = 0.0) -> None:
        self.kind = kind
        self.number = number
        self.is_started = False
        self.is_stopping = False
        self.is_alive = True
        self.exit_reason = ""
        self.last_lines: tuple[str, ...] = ()
        self.vitals = Vitals(now_s)
        self.hang = ""
        self.was_inspected = False
        self._said: dict[str, dict[str, Any]] = {}
        self._answers: dict[str, dict[str, Any] | None] = {}

    @property
    def is_in_use(self) -> bool:
        """Whether it took its `start`."""
        return self.is_started and bool(self._said.keys() & {"starting", "ready", "error", "fault"})

    @property
    def hanging_node(self) -> str:
        """Where its main thread was last seen in the user's code."""
        return str(self.vitals.place.get("text", "")) if self.vitals.is_in_action else ""

    @property
    def is_hanging(self) -> bool:
        """Whether people were told that it hangs, and it has done nothing since."""
        return bool(self.hang) and not self.vitals.is_well

    def expect(self, token: str) -> None:
        """Remembers that it was asked something by the session itself."""
        self._answers[token] = None

    def take_answer(self, message: dict[str, Any]) -> bool:
        """Takes an answer, if it was asked for by the session itself."""
        if message.get("request") not in self._answers:
            return False
        self._answers[str(message["request"])] = message
        return True

    def answer(self, token: str) -> dict[str, Any] | None:
        """Returns the answer to what it was asked, once it is there."""
        return self._answers.get(token)

    def note(self, message: dict[str, Any]) -> None:
        """Remembers the last message of each type."""
        self.vitals.heard(from_main=message["type"] not in {"beat", "log"})
        if message["type"] == "beat":
            self.vitals.beat(message)
        elif message["type"] in _TASKS:
            self.vitals.task = _TASKS[message["type"]]  # the next beat may never come
        if message["type"] == "fault" and message.get("kind") == "timeout":
            pass  # a tick that takes long may still end well
        elif message["type"] not in {"tick", "log", "blackboard", "tree", "sim", "answer", "beat"}:
            self._said[message["type"]] = message

    def said(self, type_: str) -> dict[str, Any] | None:
        """Returns the last message of a type since it was last forgotten."""
        return self._said.get(type_)

    def forget(self, *types: str) -> None:
        """Forgets messages, to wait for new ones."""
        for type_ in types:
            self._said.pop(type_, None)

    def end(self, reason: str, last_lines: tuple[str, ...] = ()) -> None:
        """The process is gone."""
        self.is_alive = False
        self.exit_reason = reason
        self.last_lines = last_lines
