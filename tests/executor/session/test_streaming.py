"""The world is asked for the streams that clients subscribed to."""

from __future__ import annotations

from executor.session import streaming
from executor.session.events import ClientLeft, StreamClosed, StreamOpened
from executor.session.ladder import State
from tests.executor.session.play import Play


def test_a_stream_is_asked_for_when_its_socket_opens_and_ended_when_it_closes() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    play.command("subscribe", stream="poses")
    assert "subscribe" not in play.told("world")
    play.happens(StreamOpened("d"))
    assert play.told("world").count("subscribe") == 1
    play.happens(StreamClosed("d"))
    assert play.told("world")[-1] == "unsubscribe"
    assert "take" in streaming.__all__


def test_a_new_world_is_asked_again() -> None:
    play = Play()
    play.happens(StreamOpened("d"))
    play.command("subscribe", stream="poses")
    play.climb(State.VISUALIZATION_READY)
    assert play.told("world").count("subscribe") == 1


def test_a_page_that_closes_after_its_world_has_died_asks_the_spare_one_for_nothing() -> None:
    play = Play()
    play.happens(StreamOpened("d"))
    play.climb(State.VISUALIZATION_READY)
    play.command("subscribe", stream="poses")
    play.command("subscribe", stream="scan")
    play.command("echo_topic", topic="/odom")
    play.child_dies("world")
    assert play.state is State.CONNECTED
    told = len(play.told("world"))
    play.command("unsubscribe", stream="scan")
    play.happens(StreamClosed("d"))
    play.happens(ClientLeft("d"))
    assert play.told("world")[told:] == []
