"""Faults of topics, which change messages on their way. Pure; time is an argument."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

__all__ = ["TopicFaults"]


class TopicFaults:
    """Silences, freezes, delays and drops messages, by topic. Faults of one topic may overlap."""

    def __init__(self) -> None:
        self._silent: dict[str, int] = {}
        self._frozen: dict[str, int] = {}
        self._delays_s: dict[str, list[float]] = {}
        self._draws: dict[str, list[tuple[float, Callable[[], float]]]] = {}
        self._last: dict[str, Any] = {}
        self._waiting: list[tuple[float, str, Any]] = []

    def silence(self, topic: str, *, on: bool) -> None:
        """Begins or ends the silence of a topic."""
        self._silent[topic] = self._silent.get(topic, 0) + (1 if on else -1)

    def freeze(self, topic: str, *, on: bool) -> None:
        """Begins or ends the repetition of a topic's last message, with its old stamp."""
        self._frozen[topic] = self._frozen.get(topic, 0) + (1 if on else -1)

    def delay(self, topic: str, delay_s: float, *, on: bool) -> None:
        """Begins or ends a delay of a topic's messages."""
        delays = self._delays_s.setdefault(topic, [])
        delays.append(delay_s) if on else delays.remove(delay_s)

    def drop(self, topic: str, share: float, draw: Callable[[], float], *, on: bool) -> None:
        """Begins or ends the loss of a share of a topic's messages; `draw` returns 0 to 1 for each."""
        draws = self._draws.setdefault(topic, [])
        draws.append((share, draw)) if on else draws.remove((share, draw))

    def take(self, topic: str, message: Any, now_s: float) -> list[Any]:
        """Returns the messages to send now in place of the given one: none or one."""
        if self._frozen.get(topic):
            message = self._last.setdefault(topic, message)
        else:
            self._last[topic] = message
        lost = [draw() < share for share, draw in self._draws.get(topic, [])]
        if self._silent.get(topic) or any(lost):
            return []
        delay_s = sum(self._delays_s.get(topic, []))
        if delay_s > 0:
            self._waiting.append((now_s + delay_s, topic, message))
            return []
        return [message]

    def due(self, now_s: float, topics: Collection[str]) -> list[tuple[str, Any]]:
        """Returns the delayed messages of some topics whose time has come, in their order."""
        found = [each for each in self._waiting if each[0] <= now_s + 1e-9 and each[1] in topics]
        for each in found:
            self._waiting.remove(each)
        return [(topic, message) for _, topic, message in sorted(found, key=lambda each: each[0])]
