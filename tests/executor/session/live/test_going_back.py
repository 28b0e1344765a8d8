"""The command `go_back` in live runs: the world of a keyframe, and the tree from its begin."""

from __future__ import annotations

import pytest

from executor import child_messages, recorder_messages
from executor.child_messages import StartApplication
from executor.messages import Error
from executor.session.events import ChildSaid, RecordingWanted
from executor.session.ladder import State
from executor.session.live import going_back
from tests.executor.session.exact.test_hosting import started, told
from tests.executor.session.play import Play
from tests.executor.session_client import SessionClient, manager_process, run_data


def recorded() -> Play:
    play = Play()
    play.happens(RecordingWanted("/records"))
    assert play.reply(play.command("run")) == "ack"
    return play


@pytest.mark.parametrize("state", [State.APPLICATION_RUNNING, State.PAUSED, State.VISUALIZATION_READY])
def test_the_world_goes_back_and_the_tree_begins_again(state: State) -> None:
    play = recorded()
    first = play.session.recording.run
    if state is State.PAUSED:
        play.command("pause")
    if state is State.VISUALIZATION_READY:
        play.command("terminate_application")
    assert play.state is state
    assert play.sent("repeatable_runs")[-1].live == [first]
    at = len(play.effects)
    assert play.reply(play.command("go_back", run=first, t=1.5)) == "ack"
    assert play.state is State.PAUSED
    (asked,) = [m for m in told(play, "recorder", at) if isinstance(m, recorder_messages.FindKeyframe)]
    assert (asked.run, asked.t) == (first, 1.5)
    (load,) = [m for m in told(play, "world", at) if isinstance(m, child_messages.LoadWorld)]
    assert load.data == b"as it was"
    one, again = started(play)
    assert (again.app_dir, again.tick_hz, again.world) == (one.app_dir, one.tick_hz, None)
    assert again.blackboard_json == '[["","k","int",3]]'
    (branch,) = play.sent("branch")
    assert (branch.parent, branch.from_t, branch.run) == (first, 1.5, play.session.recording.run)
    assert play.session.snapshot().live_runs == [first, branch.run]
    assert "back at 1.50 s" in play.sent("log")[-1].text
    assert play.session.sim_time_s == 1.5
    assert play.reply(play.command("resume")) == "ack"
    assert play.state is State.APPLICATION_RUNNING


def test_breakpoints_that_are_set_on_the_way_are_there_when_it_pauses() -> None:
    play = recorded()
    play.obedient = False
    play.command("go_back", t=1.5)
    waiting, is_set = play.effects[-3:], False
    while waiting:
        answers = [answer for effect in waiting for answer in play.answers(effect)]
        at = len(play.effects)
        if len(started(play)) == 2 and not is_set:
            is_set = play.reply(play.command("set_breakpoints")) == "ack"
        for answer in answers:
            play.happens(answer)
        waiting = play.effects[at:]
    assert play.state is State.PAUSED
    assert play.told("application")[-1] == "set_breakpoints"


def test_the_program_is_that_of_the_moment() -> None:
    play = recorded()
    first = play.session.recording.run
    play.session.sim_time_s = 3.0
    play.session.past.changed(3.0, "/changed")
    play.command("go_back", run=first, t=2.9)
    play.command("go_back", run=first, t=3.1)
    folders = [start.app_dir for start in started(play)]
    assert folders == ["/somewhere", "/somewhere", "/changed"]


def test_a_moment_that_is_not_recorded_is_refused_and_the_run_continues() -> None:
    play = recorded()
    play.obedient = False
    request = play.command("go_back", t=0.0)
    (asked,) = [m for m in told(play, "recorder") if isinstance(m, recorder_messages.FindKeyframe)]
    number = play.session.children.living["recorder"].number
    error = Error("not_recorded", "There is none.")
    play.happens(ChildSaid("recorder", number, child_messages.Answer(request=asked.request, error=error)))
    assert play.reply(request) == "not_recorded"
    assert play.state is State.APPLICATION_RUNNING


def test_without_a_recorder_it_is_refused_and_the_run_continues() -> None:
    play = Play()
    play.command("run")
    assert play.reply(play.command("go_back", t=0.5)) == "not_recorded"
    assert play.state is State.APPLICATION_RUNNING
    assert play.reply(play.command("go_back", run="ffff", t=0.5)) == "unknown_run"


def test_a_program_that_cannot_be_loaded_again_leaves_the_world() -> None:
    play = recorded()
    play.command("terminate_application")
    play.obedient = False
    request = play.command("go_back", t=1.0)
    number = play.session.children.living["recorder"].number
    (asked,) = [m for m in told(play, "recorder") if isinstance(m, recorder_messages.FindKeyframe)]
    found = recorder_messages.WorldKeyframe(1.0, b"as it was", "[]")
    play.happens(ChildSaid("recorder", number, found))
    play.happens(ChildSaid("recorder", number, child_messages.Answer(request=asked.request)))
    (load,) = [m for m in told(play, "world") if isinstance(m, child_messages.LoadWorld)]
    play.child_says("world", "answer", request=load.request)
    assert isinstance(told(play, "application")[-1], StartApplication)
    play.child_says("application", "starting")
    play.child_says("application", "fault", kind="load", message="It is broken.")
    assert play.reply(request) == "load_failed"
    assert going_back.LOAD_S > going_back.FIND_S
    assert play.state is State.VISUALIZATION_READY
    play.obedient = True
    assert play.reply(play.command("go_back", t=1.0)) == "ack"


@pytest.mark.simulation
async def test_a_real_live_run_goes_back_and_runs_on() -> None:
    """The robot is where it was, time continues from there, and the branch is recorded."""
    async with manager_process() as manager:
        client = await SessionClient(manager.ready["port"]).open()
        data = run_data()
        data["universe"]["speed"] = 5.0
        assert await client.ask("run", data) == "ack"
        await client.event("tick", lambda d: d["n"] > 280)
        assert await client.ask("pause") == "ack"
        late_s = client.events[-1]["t"]
        at = len(client.events)
        for bad in ({"t": -1.0}, {"t": "x"}, {"run": 3}, {"more": 1}):
            assert (await client.ask("go_back", bad))["code"] == "bad_data"
        assert (await client.ask("go_back", {"run": "ffff", "t": 1.0}))["code"] == "unknown_run"
        assert client.state == "paused"
        assert await client.ask("go_back", {"t": 8.0}) == "ack"
        assert client.state == "paused"
        branch = client.named("branch", at)[-1]
        assert 2.9 < branch["from_t"] <= 8.0
        # What can be repeated is named at the end of the step, so behind the reply.
        await client.event("repeatable_runs", lambda d: d["live"][-1:] == [branch["run"]], after=at)
        at = len(client.events)
        assert await client.ask("resume") == "ack"
        segment = await client.event("segment", lambda d: d["run"] == branch["run"] and d["bytes"])
        assert segment["data"]["from_t"] == pytest.approx(branch["from_t"], abs=0.01)
        tick = await client.event("tick", lambda d: d["n"] > 5, after=at)
        assert branch["from_t"] <= tick["t"] < late_s
        assert await client.ask("disconnect") == "ack"
        await client.close()
