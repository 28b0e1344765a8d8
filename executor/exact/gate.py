"""The channel of an exact run: quiet while the run is made again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from executor import child_messages

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.supervision.channel import Channel

__all__ = ["Gate"]

_PASSES: Final = (child_messages.Starting, child_messages.GoingBack, child_messages.Differs)
"""What is sent also while the gate is closed."""


class Gate:
    """Sends messages to the session; while it is closed, only those that do not belong to the past.

    `send_state` sends what the session must know of the past all the same: changed ports, and forced results,
    also from before it was closed, since a snapshot may be all that is left of that.
    """

    def __init__(self, channel: Channel[Any, Any]) -> None:
        self._channel = channel
        self._is_closed = False
        self._ports: dict[tuple[str, str, str], child_messages.PortSet] = {}
        self._forced: child_messages.Forced | None = None

    def close_for_replay(self) -> None:
        """Keeps back what the run has to say."""
        self._is_closed = True

    def open(self) -> None:
        """Sends all that follows."""
        self._is_closed = False

    def lead_to(self, other: Any) -> None:
        """Sends all that follows elsewhere: in a copy of the process that has no session."""
        self._channel = other
        self._is_closed = False

    def send_state(self) -> None:
        """Sends what has changed since the run began, and holds still."""
        for message in self._ports.values():
            self._channel.send(message)
        if self._forced is not None:
            self._channel.send(self._forced)

    def send(self, message: Struct) -> None:
        """Sends a message, or keeps it back."""
        if not self._is_closed or isinstance(message, _PASSES):
            self._channel.send(message)
        if isinstance(message, child_messages.PortSet):
            self._ports[message.path, message.node_id, message.port] = message
        elif isinstance(message, child_messages.Forced):
            self._forced = message
        elif isinstance(message, child_messages.Applied):
            self._ports = {}  # the ports are those of the changed tree

    def wait(self) -> None:
        """Waits until the session has sent something."""
        self._channel.wait()

    def receive(self, timeout_s: float | None = None) -> Any:
        """Returns the next message of the session; None after the timeout."""
        return self._channel.receive(timeout_s)

    def flush(self, timeout_s: float) -> bool:
        """Waits until all messages are written; returns whether they are."""
        return self._channel.flush(timeout_s)
