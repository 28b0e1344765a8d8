"""The command `go_back` in the session: its run, its messages, and its failures."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from executor import child_messages
from executor.child_messages import StartApplication
from executor.replay_messages import Input
from executor.session.events import RecordingWanted, Send, StreamOpened
from executor.session.exact.going_back import NO_RUN
from executor.session.ladder import State
from tests.executor.session.exact.test_hosting import RUN, running, started, told
from tests.executor.session.play import APPLICATION, HELD, Play

TELEOP = msgspec.msgpack.encode(child_messages.ForWorld(child_messages.Teleop(0.1, 0.2)))


def recorded() -> Play:
    play = Play()
    play.happens(RecordingWanted("/records"))
    assert play.reply(play.command("run", **RUN)) == "ack"
    play.child_says("application", "fingerprints", data=b"12345678" * 3)
    play.child_says("application", "entered", input=[1, 12, -1, TELEOP])
    return play


def test_the_run_is_made_again_and_stands_at_the_moment() -> None:
    play = recorded()
    first = play.session.recording.run
    assert play.reply(play.command("go_back", t=1.5)) == "ack"
    assert play.state is State.PAUSED
    one, again = started(play)
    assert (again.world, again.app_dir, again.seed) == (one.world, one.app_dir, one.seed)
    assert again.replay is not None
    assert again.replay.inputs == [Input(1, 12, -1, TELEOP)]
    assert (again.replay.until_s, again.replay.fingerprints) == (1.5, b"12345678" * 3)
    assert play.session.children.host is play.session.children.get("application")
    assert [event.fraction for event in play.sent("going_back")] == [0.0, 1.0]
    (branch,) = play.sent("branch")
    assert (branch.parent, branch.from_t, branch.run) == (first, 1.5, play.session.recording.run)
    assert branch in play.session.snapshot().branches
    assert "back at 1.50 s" in play.sent("log")[-1].text
    assert play.session.sim_time_s == 1.5
    assert play.reply(play.command("resume")) == "ack"
    assert play.state is State.APPLICATION_RUNNING


def test_going_back_ends_a_hold() -> None:
    play = recorded()
    play.command("set_breakpoints")
    play.child_says("application", "held", **HELD)
    assert play.state is State.HELD
    assert play.reply(play.command("go_back", t=1.5)) == "ack"
    assert play.state is State.PAUSED
    assert play.session.snapshot().held is None
    assert play.reply(play.command("resume")) == "ack"


def test_the_recording_of_a_branch_names_its_parent() -> None:
    play = recorded()
    first = play.session.recording.run
    play.command("go_back", t=1.5)
    begun = [message for message in told(play, "recorder") if type(message).__name__ == "BeginRun"]
    assert "parent" not in begun[0].about
    assert (begun[1].about["parent"], begun[1].about["from_t"]) == (first, "1.5")
    play.command("run", **RUN)
    begun = [message for message in told(play, "recorder") if type(message).__name__ == "BeginRun"]
    assert "parent" not in begun[-1].about


def test_views_follow_and_speed_and_breakpoints_are_those_of_now() -> None:
    play = Play()
    play.happens(StreamOpened("d"))
    play.command("subscribe", stream="poses")
    play.command("run", **RUN)
    play.command("set_speed", speed=3.0)
    play.command("set_breakpoints")
    at = len(play.effects)
    assert play.reply(play.command("go_back", t=0.5)) == "ack"
    messages = told(play, "application", at)
    (start,) = [message for message in messages if isinstance(message, StartApplication)]
    assert start.world is not None
    assert start.world.speed == 3.0
    assert start.breakpoints is None  # those of its begin: the others entered later
    kinds = [type(message).__name__ for message in messages]
    assert "SetBreakpoints" in kinds[kinds.index("StartApplication") :]
    commands = [m.command for m in messages if isinstance(m, child_messages.ForWorld)]
    assert any(isinstance(command, child_messages.Subscribe) for command in commands)


@pytest.mark.parametrize("state", [State.APPLICATION_RUNNING, State.PAUSED, State.VISUALIZATION_READY])
def test_it_is_possible_also_when_the_program_has_ended(state: State) -> None:
    play = recorded()
    if state is State.PAUSED:
        play.command("pause")
    if state is State.VISUALIZATION_READY:
        play.child_dies("application")
    assert play.state is state
    assert play.reply(play.command("go_back")) == "ack"
    assert play.state is State.PAUSED
    assert started(play)[-1].replay.until_s is None


def test_an_earlier_run_of_the_same_world_is_found_and_one_of_another_world_is_not() -> None:
    play = recorded()
    first = play.session.recording.run
    play.command("run", **RUN)
    assert play.reply(play.command("go_back", run=first, t=0.5)) == "ack"
    assert play.sent("branch")[-1].parent == first
    assert play.reply(play.command("go_back", run="ffff", t=0.5)) == "unknown_run"
    assert play.state is State.PAUSED
    other: dict[str, Any] = {
        "universe": {**RUN["universe"], "universe": "warehouse"},
        "application": APPLICATION,
    }
    assert play.reply(play.command("run", **other)) == "ack"
    assert play.reply(play.command("go_back", run=first)) == "unknown_run"


def test_without_a_run_it_is_refused() -> None:
    play = Play()
    play.climb(State.VISUALIZATION_READY)
    assert play.reply(play.command("go_back", t=0.5)) == "no_run"
    sent = [effect.payload for effect in play.effects if isinstance(effect, Send)]
    assert any(getattr(payload, "message", "") == NO_RUN for payload in sent)
    assert play.state is State.VISUALIZATION_READY


def test_a_run_with_too_much_is_refused_and_continues() -> None:
    play = recorded()
    run = play.session.past.find("")
    assert run is not None
    run.refusal = "This run is too long"
    assert play.reply(play.command("go_back", t=0.5)) == "not_repeatable"
    assert play.state is State.APPLICATION_RUNNING


def test_a_run_that_cannot_be_made_again_says_why_and_can_be_tried_again() -> None:
    play = recorded()
    play.obedient = False
    request = play.command("go_back", t=1.0)
    play.child_says("application", "world_state", data=b"as it was left")
    play.child_dies("application", "ended with exit code 0")
    play.child_says("application", "starting")
    play.child_says("application", "going_back", fraction=0.4)
    play.child_says("application", "fault", kind="load", message="The run ended on the way.")
    assert play.reply(request) == "load_failed"
    assert [event.fraction for event in play.sent("going_back")] == [0.0, 0.4, 1.0]
    assert play.state is State.VISUALIZATION_READY
    play.obedient = True
    assert play.reply(play.command("go_back", t=0.5)) == "ack"


def test_it_can_be_cancelled() -> None:
    play = recorded()
    play.obedient = False
    request = play.command("go_back", t=1.0)
    play.child_says("application", "world_state", data=b"as it was left")
    play.child_dies("application", "ended with exit code 0")
    play.child_says("application", "starting")
    play.obedient = True
    play.command("cancel")
    assert play.reply(request) == "cancelled"
    assert play.state is State.VISUALIZATION_READY
    assert play.reply(play.command("go_back")) == "ack"


def test_a_run_that_differs_is_reported_once_it_is_there() -> None:
    play = recorded()
    play.obedient = False
    request = play.command("go_back", t=1.0)
    play.child_says("application", "world_state", data=b"as it was left")
    play.child_dies("application", "ended with exit code 0")
    play.child_says("application", "starting")
    play.child_says("application", "differs", tick=7, t=0.3, cause="threads")
    reached = {"t": 1.0, "ticks": 3, "inputs": 1, "resets": 0, "tick_hz": 20.0}
    play.child_says("application", "went_back", **reached)
    play.child_says("application", "ready")
    assert play.reply(request) == "ack"
    (differs,) = play.sent("differs")
    assert (differs.tick, differs.cause) == (7, "threads")
    assert any("tick 7" in line.text for line in play.sent("log"))


def test_a_run_that_makes_no_progress_ends() -> None:
    play = recorded()
    play.obedient = False
    request = play.command("go_back", t=1.0)
    play.child_says("application", "world_state", data=b"as it was left")
    play.child_dies("application", "ended with exit code 0")
    play.child_says("application", "starting")
    for _ in range(5):
        play.later(50.0)
        play.child_says("application", "going_back", fraction=0.1)
    assert play.reply(request) is None
    play.later(61.0)
    assert play.reply(request) == "timeout"


def test_the_reset_of_a_run_belongs_to_it() -> None:
    play = recorded()
    first = play.session.recording.run
    play.command("reset_world")
    second = play.session.recording.run
    assert second != first
    assert play.session.past.find(first) is not None
    assert play.session.past.find(second) is not None


def test_clients_know_in_which_runs_one_can_go_back() -> None:
    play = recorded()
    first = play.session.recording.run
    play.command("go_back", t=1.5)
    both = [first, play.session.recording.run]
    assert play.sent("repeatable_runs")[-1].runs == both
    assert play.session.snapshot().repeatable_runs == both
    play.command("disconnect")
    assert play.sent("repeatable_runs")[-1].runs == []


def test_hosting_is_as_in_other_runs() -> None:
    play = running()
    play.command("go_back")
    at = len(play.effects)
    play.command("terminate_application")
    assert any(isinstance(message, child_messages.LoadWorld) for message in told(play, "world", at))
