"""What the session knows of one child process, from what it said."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from executor.session.events import Kind

__all__ = ["Child"]


class Child:
    """A world or an application process.

    A child is spawned ahead of its use; it counts from the `start` that it was told.
    """

    def __init__(self, kind: Kind, number: int) -> None:
        self.kind = kind
        self.number = number
        self.is_started = False
        self.is_stopping = False
        self.is_alive = True
        self.exit_reason = ""
        self.last_lines: tuple[str, ...] = ()
        self.hanging_node = ""
        self._said: dict[str, dict[str, Any]] = {}

    def note(self, message: dict[str, Any]) -> None:
        """Remembers the last message of each type."""
        if message["type"] == "heartbeat":
            self.hanging_node = str(message.get("in_tick_node") or "")
        elif message["type"] == "fault" and message.get("kind") == "timeout":
            pass  # a tick that takes long may still end well
        elif message["type"] not in {"tick", "log", "blackboard", "tree", "sim"}:
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
