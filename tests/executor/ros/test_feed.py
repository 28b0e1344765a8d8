from typing import Any

from executor.ros.feed import Feed


class Publisher:
    """Counts what it is given; `listeners` says how many hear it."""

    def __init__(self, listeners: int) -> None:
        self.listeners = listeners
        self.sent: list[Any] = []

    def get_subscription_count(self) -> int:
        return self.listeners

    def publish(self, message: Any) -> None:
        self.sent.append(message)


def test_it_measures_when_due_and_only_for_who_listens() -> None:
    heard, unheard = Publisher(1), Publisher(0)
    measured: list[float] = []

    def make(_: Any, now_s: float) -> float:
        measured.append(now_s)
        return now_s

    feed = Feed([heard, unheard], make, rate_hz=10.0)
    for i in range(61):
        feed.publish(None, i / 60)  # type: ignore[arg-type]
    assert len(heard.sent) == len(measured) == 11
    assert unheard.sent == []
    feed.due.restart()
    heard.listeners = 0
    assert not feed.has_receiver
    feed.publish(None, 0.0)  # type: ignore[arg-type]
    assert len(measured) == 11
