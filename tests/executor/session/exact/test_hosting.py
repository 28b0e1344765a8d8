"""Exact runs in the session: who has the world, and what becomes of it."""

from __future__ import annotations

from typing import Any

import pytest

from executor import child_messages, messages
from executor.child_messages import ForWorld, LoadWorld, StartApplication
from executor.launching.model import LaunchPlan, NodeSpec
from executor.session.events import Kill, Send, Spawn, StreamOpened, Tell, Unpack, Unpacked
from executor.session.exact.hosting import choose
from executor.session.ladder import State
from tests.executor.session.play import APPLICATION, UNIVERSE, Play

EXACT: dict[str, Any] = {**UNIVERSE, "time": "exact"}
RUN: dict[str, Any] = {"universe": EXACT, "application": APPLICATION}


def running(**more: Any) -> Play:
    play = Play()
    assert play.reply(play.command("run", **{**RUN, **more})) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    return play


def told(play: Play, kind: str, since: int = 0) -> list[Any]:
    return [e.message for e in play.effects[since:] if isinstance(e, Tell) and e.kind == kind]


def started(play: Play) -> list[StartApplication]:
    return [message for message in told(play, "application") if isinstance(message, StartApplication)]


def test_a_run_has_its_world_in_it_and_begins_it_again() -> None:
    play = running()
    (start,) = started(play)
    assert start.world is not None
    assert (start.world.universe, start.world.seed, start.world_state) == ("walled_room", 1, b"")
    assert [e.kind for e in play.effects if isinstance(e, Spawn) and e.is_exact] == ["application"]
    assert play.session.children.host is play.session.children.get("application")


def test_a_run_loads_while_the_world_is_launched_and_ends_with_it() -> None:
    play = Play(obedient=False)
    request = play.command("run", universe={**EXACT, "speed": 2.0}, application=APPLICATION)
    (unpack,) = [effect for effect in play.effects if isinstance(effect, Unpack)]
    play.happens(Unpacked(unpack.token, "/somewhere"))
    (start,) = started(play)
    assert start.world is not None
    assert start.world.speed == 2.0
    play.child_says("application", "ready")
    assert play.state is State.CONNECTED
    assert play.did(Kill) == ["application"]  # the spare for a live run
    play.child_says("world", "error", code="launch_failed", message="No such universe.")
    assert play.reply(request) == "launch_failed"
    assert play.did(Kill) == ["application", "world", "application"]


def test_a_live_run_has_not() -> None:
    play = running(universe=UNIVERSE)
    assert started(play)[0].world is None
    assert play.session.children.host is None
    assert not any(isinstance(e, Spawn) and e.is_exact for e in play.effects)


def test_commands_for_the_world_go_to_the_run() -> None:
    play = running()
    at = len(play.effects)
    assert play.reply(play.command("set_speed", speed=3.0)) == "ack"
    play.command("teleop", linear=0.1, angular=0.0)
    assert play.reply(play.command("pause")) == "ack"
    assert play.reply(play.command("step")) == "ack"
    assert play.reply(play.command("resume")) == "ack"
    assert told(play, "world", at) == []
    for_world = [m.command for m in told(play, "application", at) if isinstance(m, ForWorld)]
    assert [type(command).__name__ for command in for_world] == [
        "SetSpeed",
        "Teleop",
        "Pause",
        "StepWorld",
        "Resume",
    ]


def test_streams_move_to_the_run_and_back() -> None:
    play = Play()
    play.happens(StreamOpened("d"))
    play.command("subscribe", stream="poses")
    play.command("run", **RUN)
    application = [m.command for m in told(play, "application") if isinstance(m, ForWorld)]
    assert any(isinstance(command, child_messages.Subscribe) for command in application)
    assert isinstance(told(play, "world")[-1], child_messages.Unsubscribe)
    at = len(play.effects)
    assert play.reply(play.command("terminate_application")) == "ack"
    assert any(isinstance(message, child_messages.Subscribe) for message in told(play, "world", at))


def test_the_world_comes_back_as_the_run_left_it_and_the_next_run_begins_with_it() -> None:
    play = running()
    play.command("set_speed", speed=3.0)
    at = len(play.effects)
    play.command("terminate_application")
    back = told(play, "world", at)
    assert back[0] == LoadWorld(b"as it was left")
    assert child_messages.SetSpeed(3.0) in back
    assert play.session.children.host is None
    assert play.reply(play.command("restart_application")) == "ack"
    again = started(play)[-1]
    assert again.world_state == b"as it is"
    assert again.world is not None
    assert again.world.speed == 3.0
    numbers = [e.number for e in play.effects if isinstance(e, Tell) and e.message in started(play)]
    assert len(set(numbers)) == 2  # a process that has loaded an application never loads another


def test_run_application_takes_the_launched_world_over() -> None:
    play = Play()
    play.command("connect")
    play.command("launch_universe", **EXACT)
    play.command("prepare_visualization")
    play.command("run_world")
    assert play.reply(play.command("run_application")) == "ack"
    (start,) = started(play)
    assert start.world_state == b"as it is"
    world = told(play, "world")
    dump = next(i for i, message in enumerate(world) if isinstance(message, child_messages.DumpWorld))
    assert any(isinstance(message, child_messages.Pause) for message in world[:dump])


@pytest.mark.parametrize("reason", ["root_finished", "action_raised"])
def test_the_end_of_a_tree_leaves_the_world(reason: str) -> None:
    play = running()
    at = len(play.effects)
    play.child_says("application", "world_state", data=b"the end")
    play.child_says("application", "finished", status="SUCCESS", reason=reason)
    assert play.state is State.VISUALIZATION_READY
    assert told(play, "world", at)[0] == LoadWorld(b"the end")


def test_a_run_that_dies_leaves_the_world_as_it_was_before() -> None:
    play = running()
    play.command("set_speed", speed=2.0)
    at = len(play.effects)
    play.child_dies("application")
    assert play.state is State.VISUALIZATION_READY
    assert not any(isinstance(message, LoadWorld) for message in told(play, "world", at))
    assert "as it was when the run began" in [log.text for log in play.sent("log")][-1]
    assert play.reply(play.command("run", **RUN)) == "ack"


def test_a_state_of_a_process_that_has_no_world_is_not_taken() -> None:
    play = running(universe=UNIVERSE)
    at = len(play.effects)
    play.child_says("application", "world_state", data=b"forged")
    assert told(play, "world", at) == []


def test_the_idle_world_says_nothing_while_the_run_has_it() -> None:
    play = running()
    sim: dict[str, Any] = {"t": 3.0}
    sim |= {"real_time_factor": 1.0, "speed": 1.0, "paused": True, "camera_share": 1.0}
    sim |= {"tick_ms": 0.0, "tick_budget_ms": 0.0, "collisions": 0, "distance_m": 0.0, "pose": (0, 0, 0)}
    play.child_says("world", "sim", **sim)
    assert play.sent("sim") == []
    play.child_says("application", "sim", **sim)
    assert len(play.sent("sim")) == 1


def test_lines_of_a_world_in_a_run_are_those_of_the_world() -> None:
    play = running()
    play.child_says("application", "log", level="warning", text="robot bumped into wall", of_world=True)
    play.child_says("application", "log", level="info", text="hello")
    assert [(log.source, log.text) for log in play.sent("log")] == [
        ("world", "robot bumped into wall"),
        ("action", "hello"),
    ]


def test_a_world_that_dies_ends_the_run() -> None:
    play = running()
    play.child_dies("world")
    assert play.state is State.CONNECTED
    assert play.session.children.host is None


def test_a_run_whose_time_cannot_wait_is_live_and_says_why() -> None:
    play = running(universe={**EXACT, "universe": "none"})
    assert started(play)[0].world is None
    assert [log.text for log in play.sent("log")] == [
        "This run is live: it joins an outside ROS graph, whose time does not wait."
    ]


def test_launch_files_make_a_run_live() -> None:
    play = Play()
    play.session.run.wants_exact = True
    play.session.run.plan = LaunchPlan((NodeSpec("a", "a", "p", "e", "x.launch.yaml", 1),))
    choose(play.session)
    assert not play.session.children.wants_exact
    effects = play.session.output.take()
    said = [e.payload.text for e in effects if isinstance(e, Send) and isinstance(e.payload, messages.Log)]
    assert len(said) == 1
    assert "its launch files start nodes" in said[0]


def test_a_spare_of_the_other_kind_is_replaced_once() -> None:
    play = Play()
    play.command("connect")
    play.command("launch_universe", **EXACT)
    spawned = [e.is_exact for e in play.effects if isinstance(e, Spawn) and e.kind == "application"]
    assert spawned == [False, True]
