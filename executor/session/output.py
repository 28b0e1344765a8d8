"""The output of a session: events for clients, and effects for the adapters, in order."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor import messages
from executor.session.events import Effect, Send

if TYPE_CHECKING:
    from collections.abc import Callable

    from msgspec import Struct

    from executor.session.events import CommandCame
    from executor.session.mirror import Mirror

__all__ = ["Output"]

_EVENT_NAMES: Final = {kind: name for name, kind in messages.EVENTS.items()}


class Output:
    """Collects the effects of a session until the adapters take them.

    Args:
        mirror: receives every event for all clients, so that clients that join later get its state.
    """

    def __init__(self, mirror: Mirror) -> None:
        self._mirror = mirror
        self.record: Callable[[str, Struct], None] = lambda name, event: None
        """Called with the name of each event for all clients, and the event."""
        self._effects: list[Effect] = []

    def effect(self, effect: Effect) -> None:
        """Adds an effect other than an event for clients."""
        self._effects.append(effect)

    def emit(self, event: Struct) -> None:
        """Sends an event to all clients, and to the mirror for clients that join later."""
        self._mirror.apply(event)
        name = _EVENT_NAMES[type(event)]
        self._effects.append(Send(None, name, event))
        self.record(name, event)

    def send(self, client: str, event: Struct, request: str | None = None) -> None:
        """Sends an event to one client; `request` is the id of the command that it answers."""
        self._effects.append(Send(client, _EVENT_NAMES[type(event)], event, request))

    def refuse(self, command: CommandCame, code: str, message: str, hint: str = "") -> None:
        """Answers a command with an error."""
        self.send(command.client, messages.Error(code, message, hint), command.request)

    def take(self) -> list[Effect]:
        """Returns all effects since the last call, in order."""
        effects, self._effects = self._effects, []
        return effects
