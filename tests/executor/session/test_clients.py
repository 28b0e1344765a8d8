"""Drivers and viewers, and their events: joining, leaving, reconnecting, the mirror."""

from __future__ import annotations

import msgspec

from executor.child_messages import EchoTopic, Pace, Subscribe, Unsubscribe
from executor.session.clients import MOST_STREAMS, Clients
from executor.session.events import (
    ClientJoined,
    ClientLeft,
    EndSession,
    StreamClosed,
    StreamOpened,
    StreamPaced,
    Tell,
)
from executor.session.ladder import State
from executor.session.mirror import Mirror
from tests.executor.session.play import Play


def test_the_first_client_drives_and_gets_a_snapshot():
    play = Play()
    play.happens(ClientJoined("v"))
    (first,), (second,) = play.sent("introspection", "d"), play.sent("introspection", "v")
    assert (first.role, second.role) == ("driver", "viewer")
    assert first.protocol == "bt-studio.v1"
    assert len(play.sent("snapshot", "v")) == 1


def test_a_page_that_is_loaded_again_drives_at_once():
    play = Play()
    play.happens(ClientLeft("d"))
    play.happens(ClientJoined("again"))
    assert play.sent("introspection", "again")[0].role == "driver"


def test_a_client_may_come_back_under_its_id():
    play = Play()
    clients = play.session.clients
    assert clients.client_id("d") == "d"  # the loss of its connection was not noticed yet
    play.happens(ClientLeft("d"))
    assert clients.client_id("d") == "d"
    assert clients.client_id(None) not in {None, "d"}
    assert clients.client_id("never seen") != "never seen"


def test_a_viewer_takes_over_when_the_driver_stays_away():
    play = Play()
    play.happens(ClientJoined("v"))
    play.happens(ClientLeft("d"))
    assert play.session.deadline_s == 5.0
    play.later(4.9)
    assert play.session.clients.role("v") == "viewer"
    play.later(0.1)
    assert play.sent("introspection", "v")[-1].role == "driver"


def test_a_viewer_takes_over_and_the_driver_takes_it_back():
    play = Play()
    play.command("run")
    play.happens(ClientJoined("v"))
    assert play.reply(play.command("take_over", client="v")) == "ack"
    assert [play.sent("introspection", client)[-1].role for client in "dv"] == ["viewer", "driver"]
    assert play.reply(play.command("pause")) == "not_driver"
    assert play.reply(play.command("pause", client="v")) == "ack"
    play.command("take_over", client="d")
    assert [play.sent("introspection", client)[-1].role for client in "dv"] == ["driver", "viewer"]
    assert play.reply(play.command("resume")) == "ack"
    assert play.state is State.APPLICATION_RUNNING


def test_a_step_continues_after_a_take_over_and_the_new_driver_may_cancel_it():
    play = Play(obedient=False)
    play.happens(ClientJoined("v"))
    run = play.command("run")
    play.command("take_over", client="v")
    assert play.reply(run) is None
    assert play.reply(play.command("cancel")) == "not_driver"
    assert play.reply(play.command("cancel", client="v")) == "ack"
    assert play.reply(run) == "cancelled"


def test_taking_over_without_a_driver_notifies_only_the_new_driver():
    play = Play()
    play.command("take_over")
    assert len(play.sent("introspection", "d")) == 1, "the driver drives already"
    play.happens(ClientJoined("v"))
    play.happens(ClientLeft("d"))
    play.command("take_over", client="v")
    assert play.sent("introspection", "v")[-1].role == "driver"
    assert len(play.sent("introspection", "d")) == 1
    play.happens(ClientJoined("d"))
    assert play.sent("introspection", "d")[-1].role == "viewer", "the other drives as long as it is there"


def test_the_session_ends_when_no_client_reconnects():
    play = Play()
    play.command("run")
    play.happens(ClientLeft("d"))
    assert play.session.deadline_s == 300.0
    play.later(299)
    assert play.state is State.APPLICATION_RUNNING
    play.later(1)
    assert any(isinstance(e, EndSession) for e in play.effects)


def test_coming_back_in_time_keeps_the_session():
    play = Play()
    play.command("run")
    play.happens(ClientLeft("d"))
    play.later(299)
    play.happens(ClientJoined("d"))
    play.later(1000)
    assert not any(isinstance(e, EndSession) for e in play.effects)
    assert play.sent("introspection", "d")[-1].role == "driver"


def test_streams_flow_between_prepare_and_terminate_visualization():
    play = Play()
    play.command("subscribe", stream="camera", max_hz=10.0, width=320)
    play.happens(StreamOpened("d"))
    play.climb(State.UNIVERSE_READY)
    assert "subscribe" not in play.told("world")
    play.command("prepare_visualization")
    (subscribe,) = (e for e in play.effects if isinstance(e, Tell) and isinstance(e.message, Subscribe))
    assert subscribe.message == Subscribe("d", "camera", 10.0, 320, None)
    play.command("terminate_visualization")
    assert play.told("world")[-1] == "unsubscribe"


def test_each_camera_is_a_subscription_of_its_own():
    play = Play()
    play.happens(StreamOpened("d"))
    play.climb(State.VISUALIZATION_READY)
    for sensor in ("", "rear", "rear"):
        play.command("subscribe", stream="camera", sensor=sensor)
    assert [data.sensor for data in play.session.clients.streams_of("d")] == ["", "rear"]
    play.command("unsubscribe", stream="camera")
    assert [data.sensor for data in play.session.clients.streams_of("d")] == ["rear"]
    play.happens(StreamClosed("d"))
    ended = [
        e.message.sensor for e in play.effects if isinstance(e, Tell) and isinstance(e.message, Unsubscribe)
    ]
    assert ended == ["", "rear"]


def test_a_client_cannot_subscribe_without_end():
    play = Play()
    for number in range(MOST_STREAMS):
        play.command("subscribe", stream="camera", sensor=str(number))
    assert play.reply(play.command("subscribe", stream="camera", sensor="0")) == "ack"
    assert play.reply(play.command("subscribe", stream="poses")) == "too_many"


def test_the_world_is_notified_of_slow_clients():
    play = Play()
    play.happens(StreamOpened("d"))
    play.happens(StreamPaced("d", 0.5))
    assert "pace" not in play.told("world")
    play.climb(State.VISUALIZATION_READY)
    play.happens(StreamPaced("d", 0.5))
    (told,) = (e for e in play.effects if isinstance(e, Tell) and isinstance(e.message, Pace))
    assert told.message == Pace("d", 0.5)


def test_a_stream_socket_that_reopens_gets_everything_again():
    play = Play()
    play.command("run")
    play.command("subscribe")
    assert "subscribe" not in play.told("world")
    play.happens(StreamOpened("d"))
    play.happens(StreamClosed("d"))
    play.happens(StreamOpened("d"))
    assert [t for t in play.told("world") if "subscribe" in t] == ["subscribe", "unsubscribe", "subscribe"]


def test_topic_messages_are_sent_to_their_subscribers():
    play = Play()
    play.command("run")
    play.happens(ClientJoined("v"))
    play.command("echo_topic", client="v", topic="/scan", max_hz=5.0)
    play.child_says(
        "world", "topic_message", topic="/scan", message_type="sensor_msgs/msg/LaserScan", message={}
    )
    assert len(play.sent("topic_message", "v")) == 1
    assert play.sent("topic_message", "d") == []
    play.happens(ClientLeft("v"))
    last = [e.message for e in play.effects if isinstance(e, Tell) and e.kind == "world"][-1]
    assert last == EchoTopic("/scan", 0.0)


def test_deltas_applied_to_a_snapshot_equal_a_new_snapshot():
    play = Play()
    play.command("run")
    node = {"uid": 1, "parent": 0, "type": "Forward", "kind": "Action", "name": "go", "path": "go"}
    play.child_says("application", "tree", nodes=[node | {"node_id": "n1", "tree_id": "MainTree"}])
    play.effects.clear()
    early = play.session.mirror.snapshot()
    play.child_says("application", "tick", n=1, changed=[[1, "RUNNING"]], flashed=[], duration_ms=0.1, t=0.5)
    entry = {"scope": "", "key": "speed", "type": "float", "value": 0.3}
    play.child_says("application", "blackboard", entries=[entry, entry | {"key": "gone"}])
    play.child_says("application", "blackboard", entries=[entry | {"key": "gone", "removed": True}])
    play.child_says("application", "log", level="info", text="hello", node_id="n1")
    play.command("pause")

    late = Mirror()
    late.begin_run(early.tick_hz)
    late.tree, late.universe = early.tree, early.universe
    late.state, late.statuses = State(early.state), dict(early.statuses)
    late.logs.extend(early.logs)
    for name in ("state-changed", "tick", "blackboard", "log", "fault"):
        for payload in play.sent(name):
            late.apply(payload)
    assert msgspec.to_builtins(late.snapshot()) == msgspec.to_builtins(play.session.mirror.snapshot())
    assert late.snapshot().statuses == [(1, "RUNNING")]
    assert [e.key for e in late.snapshot().blackboard] == ["speed"]
    assert play.session.sim_time_s == 0.5


def test_everyone_is_introduced_again_to_a_world_that_is_ready():
    play = Play()
    play.happens(ClientJoined("v"))
    play.command("run")
    for client in "dv":
        first, second = play.sent("introspection", client)
        assert (first.renderer, first.tf) == ("", False)
        assert (second.renderer, second.tf) == ("egl", True)
    play.happens(ClientJoined("late"))
    assert [e.renderer for e in play.sent("introspection", "late")] == ["egl"]


def test_the_same_world_again_introduces_nobody_and_one_that_is_gone_has_no_renderer():
    play = Play()
    play.command("run")
    play.command("run")
    assert len(play.sent("introspection", "d")) == 2
    play.child_dies("world", "was killed by SIGKILL")
    play.happens(ClientJoined("late"))
    assert play.sent("introspection", "late")[0].renderer == ""
    assert len(play.sent("introspection", "d")) == 2, "the state says that the world is gone"
    play.command("run")
    assert play.sent("introspection", "d")[-1].renderer == "egl"
    assert play.sent("introspection", "late")[-1].tf


def test_one_is_the_driver_and_may_be_replaced() -> None:
    clients = Clients(0.0)
    clients.join("a")
    clients.join("b")
    assert [clients.role(client) for client in ("a", "b")] == ["driver", "viewer"]
    clients.leave("a", 1.0)
    assert clients.promote(1.5, promote_s=1.0) == []
    assert clients.promote(2.0, promote_s=1.0) == ["b"]
    assert clients.take_over("b") == []


def test_topics_are_echoed_at_the_highest_rate_and_given_up_with_the_last_client() -> None:
    clients = Clients(0.0)
    for client, rate_hz in (("a", 5.0), ("b", 10.0)):
        clients.join(client)
        clients.echo(client, "/scan", rate_hz)
    assert clients.echoes() == {"/scan": 10.0}
    assert clients.leave("b", 1.0) == []
    assert clients.leave("a", 1.0) == ["/scan"]
    assert clients.is_abandoned(3.0, 2.0)
