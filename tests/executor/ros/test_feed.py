from typing import Any

from executor.ros.feed import SHOWN_HZ, UNHEARD_HZ, Coded, Feed, Feeds


class Publisher:
    """Counts its messages; `listeners` is the number of its subscribers."""

    def __init__(self, listeners: int, topic_name: str = "") -> None:
        self.listeners = listeners
        self.topic_name = topic_name
        self.sent: list[Any] = []

    def get_subscription_count(self) -> int:
        return self.listeners

    def publish(self, message: Any) -> None:
        self.sent.append(message)


def test_it_measures_when_due_and_only_for_subscribers() -> None:
    heard, unheard = Publisher(1), Publisher(0)
    measured: list[float] = []

    def make(_: Any, now_s: float) -> float:
        measured.append(now_s)
        return now_s

    feed = Feed([heard, unheard], make, rate_hz=10.0)
    feeds = Feeds([feed, Feed([Publisher(1)], lambda _s, _t: None, rate_hz=30.0)])
    for i in range(61):
        feeds.publish(None, i / 60)
    assert len(heard.sent) == len(measured) == 11
    assert unheard.sent == []
    feeds.restart()
    feeds.publish(None, 0.0)
    assert len(measured) == 12
    feeds.restart()
    heard.listeners = 0
    assert not feed.has_receiver
    feeds.publish(None, 0.0)
    assert len(measured) == 12


def test_each_rate_is_kept() -> None:
    publishers = {rate: Publisher(1) for rate in (1.0, 15.0, 60.0)}
    feeds = Feeds([Feed([publisher], lambda _, t: t, rate) for rate, publisher in publishers.items()])
    for i in range(120):
        feeds.publish(None, i / 60)
    assert {rate: len(publisher.sent) for rate, publisher in publishers.items()} == {
        1.0: 2,
        15.0: 30,
        60.0: 120,
    }


def test_cameras_are_slowed_and_nothing_else() -> None:
    picture, info, scan = Publisher(1), Publisher(1), Publisher(1)
    feeds = Feeds(
        [
            Feed([picture], lambda _, t: t, 15.0, is_picture=True, of_camera=True),
            Feed([info], lambda _, t: t, 15.0, of_camera=True),
            Feed([scan], lambda _, t: t, 15.0),
        ]
    )
    feeds.slow_cameras(0.2)
    for i in range(60):
        feeds.publish(None, i / 60)
    assert picture.sent == info.sent
    assert (len(picture.sent), len(scan.sent)) == (3, 15)
    feeds.slow_cameras(1.0)
    for i in range(60, 120):
        feeds.publish(None, i / 60)
    assert (len(picture.sent), len(scan.sent)) == (18, 30)


def test_a_tap_gets_what_is_sent_and_samples_of_all_else() -> None:
    heard, unheard, shown = Publisher(1, "/heard"), Publisher(0, "/unheard"), Publisher(0, "/shown")
    feeds = Feeds(
        [
            *(Feed([one], lambda _, t: t, 30.0) for one in (heard, unheard)),
            Feed([shown], lambda _, t: t, 30.0, unheard_hz=SHOWN_HZ),
        ]
    )
    taken: list[Any] = []
    feeds.sample()
    for i in range(60):
        feeds.publish(None, i / 60, lambda topic, _, now_s: taken.append((topic, now_s)))
    counts = {topic: sum(found == topic for found, _ in taken) for topic in ("/heard", "/unheard", "/shown")}
    assert counts == {"/heard": 30, "/unheard": UNHEARD_HZ, "/shown": SHOWN_HZ}
    feeds.restart()
    taken.clear()
    feeds.publish(None, 0.0, lambda topic, _, now_s: taken.append((topic, now_s)))
    assert len(taken) == 3


def test_a_topic_that_only_a_recording_takes_is_encoded_for_it_alone() -> None:
    publisher, said = Publisher(0, "/tf"), []
    coded = Coded("k", b"data")
    feed = Feed([publisher], lambda _, t: "message", rate_hz=10.0, encode=lambda _: coded)
    feed.publish(None, 0.0, lambda *message: said.append(message))
    feed.publish(None, 0.1)
    publisher.listeners = 1
    feed.publish(None, 0.2, lambda *message: said.append(message))
    assert said == [("/tf", coded, 0.0), ("/tf", "message", 0.2)]
    assert publisher.sent == ["message"]


def test_a_picture_comes_with_what_codes_it() -> None:
    publisher, said = Publisher(1, "/camera/image_raw"), []
    code = lambda _: b"jpeg"  # noqa: E731 - one line
    feed = Feed([publisher], lambda _, t: "message", 10.0, is_picture=True, of_camera=True, jpeg=code)
    feed.publish(None, 0.0, lambda *message: said.append(message))
    ((topic, shown, now_s),) = said
    assert (topic, shown.message, shown.jpeg(), now_s) == ("/camera/image_raw", "message", b"jpeg", 0.0)
    assert publisher.sent == ["message"]
