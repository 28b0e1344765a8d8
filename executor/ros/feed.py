"""Topics with a rate: measured when they are due, and only if they have subscribers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.ros.topic_faults import TopicFaults
    from executor.world.sensing.sensors import Sensors

    Tap = Callable[[str, Any, float], None]

UNHEARD_HZ: Final = 2.0
SHOWN_HZ: Final = 10.0
"""The rate of measurements that views show, also where no ROS node receives them."""


class Coded(NamedTuple):
    """A message of a type (`tf2_msgs/msg/TFMessage`) as CDR, for a tap alone."""

    kind: str
    data: bytes


class Shown(NamedTuple):
    """A picture for a tap: its message, and what returns it as JPEG."""

    message: Any
    jpeg: Callable[[], bytes]


class Due:
    """A timer of a given rate, counted from the simulated time 0."""

    def __init__(self, rate_hz: float) -> None:
        self.rate_hz = rate_hz
        self._done = -1

    def __call__(self, time_s: float) -> bool:
        """Returns whether a turn is due at this simulated time; if so, counts it as done."""
        turn = int(time_s * self.rate_hz + 1e-6)
        if turn == self._done:
            return False
        self._done = turn
        return True

    def restart(self) -> None:
        """Restarts at the simulated time 0."""
        self._done = -1


@dataclass(frozen=True)
class Feed:
    """A measurement, and the publishers that send its message. `make` measures and returns the message.

    Without subscribers it is measured for a tap at most `unheard_hz` times in a second, if `Feeds.sample` was
    called. `is_picture` is set if the measurement must be rendered; `of_camera` is also set for messages that
    accompany a picture. `encode` returns the message for a tap where nobody else takes it; `jpeg` returns a
    picture that clients may get too.
    """

    publishers: list[Any]
    make: Callable[[Sensors, float], Any]
    rate_hz: float
    is_picture: bool = False
    of_camera: bool = False
    unheard_hz: float = UNHEARD_HZ
    encode: Callable[[float], Coded] | None = None
    jpeg: Callable[[Sensors], bytes] | None = None

    @property
    def has_receiver(self) -> bool:
        """Whether one of the publishers has a subscriber."""
        return any(publisher.get_subscription_count() for publisher in self.publishers)

    def publish(
        self,
        sensors: Sensors,
        now_s: float,
        tap: Tap | None = None,
        *,
        is_sampled: bool = True,
        faults: TopicFaults | None = None,
    ) -> None:
        """Measures and publishes to the topics with subscribers.

        A tap gets all messages of these topics. If `is_sampled` is set it counts as a subscriber, but not for
        cameras.
        """
        receivers = [publisher for publisher in self.publishers if publisher.get_subscription_count()]
        if not receivers and (tap is None or self.of_camera or not is_sampled):
            return
        if self.encode is not None and tap is not None and not receivers and faults is None:
            for publisher in self.publishers:
                tap(publisher.topic_name, self.encode(now_s), now_s)
            return
        message = self.make(sensors, now_s)
        if faults is not None:
            self._publish_faulty(message, now_s, tap, faults)
            return
        for publisher in receivers:
            publisher.publish(message)
        if tap is not None:
            shown = message if self.jpeg is None else Shown(message, partial(self.jpeg, sensors))
            for publisher in receivers if self.of_camera else self.publishers:
                tap(publisher.topic_name, shown, now_s)

    def _publish_faulty(self, message: Any, now_s: float, tap: Tap | None, faults: TopicFaults) -> None:
        for publisher in self.publishers:
            if self.of_camera and not publisher.get_subscription_count():
                continue
            for sent in faults.take(publisher.topic_name, message, now_s):
                send(publisher, sent, now_s, tap)


def send(publisher: Any, message: Any, now_s: float, tap: Tap | None) -> None:
    """Publishes a message if its topic has subscribers, and gives it to a tap."""
    if publisher.get_subscription_count():
        publisher.publish(message)
    if tap is not None:
        tap(publisher.topic_name, message, now_s)


class Feeds:
    """Feeds, grouped by rate: many have the same rate, and in most calls none is due."""

    def __init__(self, feeds: Sequence[Feed]) -> None:
        groups: dict[tuple[float, bool, float], list[Feed]] = {}
        for feed in feeds:
            groups.setdefault((feed.rate_hz, feed.of_camera, feed.unheard_hz), []).append(feed)
        self._groups = [(Due(rate_hz), members) for (rate_hz, *_), members in groups.items()]
        self._samples: list[Due] | None = None
        self.faults: TopicFaults | None = None
        """Changes the messages on their way, if it is set."""

    @property
    def topics(self) -> set[str]:
        """The names of all topics of the feeds."""
        return {
            publisher.topic_name
            for _, feeds in self._groups
            for feed in feeds
            for publisher in feed.publishers
        }

    def sample(self) -> None:
        """Limits the rate at which a tap gets topics without subscribers."""
        self._samples = [Due(min(due.rate_hz, feeds[0].unheard_hz)) for due, feeds in self._groups]

    def publish(self, sensors: Sensors, now_s: float, tap: Tap | None = None) -> None:
        """Publishes the feeds that are due, also to a tap."""
        if self.faults is not None:
            self._send_delayed(self.faults, now_s, tap)
        for place, (is_due, feeds) in enumerate(self._groups):
            if is_due(now_s):
                is_sampled = self._samples is None or self._samples[place](now_s)
                for feed in feeds:
                    feed.publish(sensors, now_s, tap, is_sampled=is_sampled, faults=self.faults)

    def _send_delayed(self, faults: TopicFaults, now_s: float, tap: Tap | None) -> None:
        publishers = {p.topic_name: p for _, feeds in self._groups for feed in feeds for p in feed.publishers}
        for topic, message in faults.due(now_s, publishers):
            send(publishers[topic], message, now_s, tap)

    def slow_cameras(self, share: float) -> None:
        """Reduces the rates of cameras to a share of their configured rates."""
        for due, feeds in self._groups:
            if feeds[0].of_camera:
                due.rate_hz = feeds[0].rate_hz * share

    def restart(self) -> None:
        """Restarts at the simulated time 0."""
        for due in [*(due for due, _ in self._groups), *(self._samples or [])]:
            due.restart()
