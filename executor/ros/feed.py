"""A topic that is fed at a rate: measured when it is due, and only if somebody receives it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.world.sensors import Sensors


class Due:
    """Tells when something of a given rate is to be done again, counted from the simulated time 0."""

    def __init__(self, rate_hz: float) -> None:
        self._rate_hz = rate_hz
        self._done = -1

    def __call__(self, time_s: float) -> bool:
        """Tells whether it is due, and counts it as done."""
        turn = int(time_s * self._rate_hz + 1e-6)
        if turn == self._done:
            return False
        self._done = turn
        return True

    def restart(self) -> None:
        """Begins anew: simulated time is 0 again."""
        self._done = -1


@dataclass
class Feed:
    """One measurement and the publishers that it goes to; `make` measures."""

    publishers: list[Any]
    make: Callable[[Sensors, float], Any]
    rate_hz: float
    is_picture: bool = False
    due: Due = field(init=False)

    def __post_init__(self) -> None:
        self.due = Due(self.rate_hz)

    @property
    def has_receiver(self) -> bool:
        """Tells whether anybody listens."""
        return any(publisher.get_subscription_count() for publisher in self.publishers)

    def publish(self, sensors: Sensors, now_s: float) -> None:
        """Sends what is due now to those who listen."""
        if not self.due(now_s):
            return
        receivers = [publisher for publisher in self.publishers if publisher.get_subscription_count()]
        if receivers:
            message = self.make(sensors, now_s)
            for publisher in receivers:
                publisher.publish(message)
