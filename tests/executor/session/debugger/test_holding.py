"""Holds in the session: the ladder, the world, limits, clients that leave, and random plays."""

from __future__ import annotations

import os
import random
import sys

import pytest

from executor.child_messages import Continue, SetBreakpoints, StartApplication
from executor.session.debugger.holding import HOLD_DRIVER_GRACE_S
from executor.session.events import ClientJoined, ClientLeft, Tell
from executor.session.ladder import TABLE, State, is_legal
from tests.budget import count
from tests.executor.session.play import DATA, HELD, Play

STEPS = ("step_into", "step_over", "step_out", "step_to")
ENDS = ("terminate_application", "disconnect", "run", "restart_application")


def held() -> Play:
    play = Play()
    play.climb(State.HELD)
    return play


def messages_of(play: Play, kind: type) -> list:
    return [e.message for e in play.effects if isinstance(e, Tell) and isinstance(e.message, kind)]


def test_a_hold_stops_the_world_and_a_release_lets_it_continue() -> None:
    play = held()
    assert play.told("world")[-1] == "pause"
    assert [e.uid for e in play.sent("held")] == [2]
    assert play.session.snapshot().held is not None
    assert play.reply(play.command("continue_run")) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    assert not play.sent("released")[-1].off
    assert play.told("world")[-1] == "resume"
    assert play.session.snapshot().held is None


def test_a_pause_of_a_held_run_has_no_effect() -> None:
    play = held()
    told = len(play.told("application"))
    assert play.reply(play.command("pause")) == "ack"
    assert play.state is State.HELD
    assert len(play.told("application")) == told


def test_the_world_is_stopped_between_the_steps_of_a_tick() -> None:
    play = held()
    told = len(play.told("world"))
    for command in STEPS:
        assert play.reply(play.command(command)) == "ack"
        play.child_says("application", "held", **HELD)
    assert play.state is State.HELD
    assert "resume" not in play.told("world")[told:]


def test_a_hold_meets_a_pause_that_is_under_way() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    request = play.command("pause")
    play.child_says("application", "held", **HELD)
    play.child_says("application", "paused")
    play.child_says("world", "answer", request=messages_of_world(play)[-1])
    assert play.reply(request) == "ack"
    assert play.state is State.HELD


def messages_of_world(play: Play) -> list[str]:
    return [
        getattr(e.message, "request", "")
        for e in play.effects
        if isinstance(e, Tell) and e.kind == "world" and getattr(e.message, "request", None)
    ]


def test_a_step_of_a_paused_run_that_is_held_ends_with_the_hold() -> None:
    play = Play()
    play.climb(State.PAUSED)
    play.obedient = False
    request = play.command("step")
    play.child_says("application", "held", **HELD)
    assert play.reply(request) == "ack"
    assert play.state is State.HELD


def test_a_tree_that_is_held_before_the_run_is_reported_stays_held() -> None:
    play = Play()
    play.command("set_breakpoints")
    play.obedient = False
    play.command("run")
    answers = [answer for effect in list(play.effects) for answer in play.answers(effect)]
    while answers:
        play.effects.clear()
        for answer in answers:
            play.happens(answer)
        answers = [answer for effect in list(play.effects) for answer in play.answers(effect)]
        if "resume" in play.told("application"):
            play.child_says("application", "held", **HELD)
    assert play.state is State.HELD


def test_breakpoints_are_kept_for_later_runs_and_those_set_while_it_loads_follow() -> None:
    play = Play()
    assert play.reply(play.command("set_breakpoints")) == "ack"
    play.command("run")
    [start] = messages_of(play, StartApplication)
    assert start.breakpoints.breakpoints[0].node_id == "n1"
    assert messages_of(play, SetBreakpoints) == []
    play.command("set_breakpoints", breakpoints=[])
    assert [m.wanted.breakpoints for m in messages_of(play, SetBreakpoints)] == [[]]


def begun_with(play: Play) -> list[str]:
    """Returns the blocks with the breakpoints that the last application was started with."""
    wanted = messages_of(play, StartApplication)[-1].breakpoints
    return [each.node_id for each in wanted.breakpoints]


def test_breakpoints_that_are_set_while_a_run_is_restarted_are_those_of_the_new_one() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    restart = play.command("restart_application")
    assert play.told("application")[-1] == "stop"
    given = play.command("set_breakpoints")  # the old application obeys nothing any more
    assert play.reply(given) == "ack"
    assert messages_of(play, SetBreakpoints) == []
    play.obedient = True
    play.child_dies("application", "ended with exit code 0")
    assert play.reply(restart) == "ack"
    assert begun_with(play) == ["n1"]


@pytest.mark.parametrize("ends", ["dies", "finishes", "is ended"])
def test_breakpoints_that_an_application_does_not_take_before_its_end_are_those_of_the_next(ends) -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    given = play.command("set_breakpoints")
    assert play.reply(given) is None
    play.obedient = True
    match ends:
        case "dies":
            play.child_dies("application")
        case "finishes":
            play.child_says("application", "finished", status="SUCCESS", reason="root_finished")
        case _:
            play.command("terminate_application")
    assert play.reply(given) == "ack"
    play.command("run")
    assert begun_with(play) == ["n1"]


def test_an_application_that_hangs_gets_breakpoints_once_it_continues() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    application = play.session.children.living["application"]
    application.hang = "The application does not answer."
    application.vitals.silent_s = 60.0
    assert application.is_hanging
    assert play.reply(play.command("set_breakpoints")) == "ack"
    assert play.told("application")[-1] == "set_breakpoints"


def test_breakpoints_that_are_taken_late_are_kept() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    given = play.command("set_breakpoints")
    play.later(6.0)
    assert play.reply(given) == "ack"
    play.obedient = True
    play.command("restart_application")
    assert begun_with(play) == ["n1"]


def late_breakpoints() -> tuple[Play, SetBreakpoints]:
    """Returns a run that did not answer breakpoints in time, and its question."""
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    given = play.command("set_breakpoints")
    [asked] = messages_of(play, SetBreakpoints)
    assert asked.request is not None
    play.later(6.0)
    assert play.reply(given) == "ack"
    return play, asked


def test_breakpoints_that_are_refused_late_are_given_once_more_without_a_question() -> None:
    play, asked = late_breakpoints()
    play.child_says(
        "application", "answer", request=asked.request, error={"code": "bad_breakpoint", "message": "-"}
    )
    first, again = messages_of(play, SetBreakpoints)
    assert (again.request, again.wanted) == (None, first.wanted), "it takes the good ones, and names the bad"


@pytest.mark.parametrize("change", ["others are set", "the application dies", "the hold has ended"])
def test_breakpoints_that_are_late_are_not_given_once_more_where_they_are_no_longer_wanted(change) -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    play.command("set_breakpoints")
    if change == "others are set":
        play.later(4.0)
        play.command("set_breakpoints", breakpoints=[])
    elif change == "the hold has ended":
        play.session.hold.switch_off()
    else:
        play.child_dies("application")
    play.later(2.0)
    assert all(each.request is not None for each in messages_of(play, SetBreakpoints))


def test_breakpoints_that_are_late_are_given_once_more_when_newer_ones_are_refused() -> None:
    """The application may have refused the late ones, too; session and application agree again."""
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    play.command("set_breakpoints")
    play.later(4.0)
    newer = play.command("set_breakpoints", breakpoints=[{"tree_id": "Main", "node_id": "n2"}])
    play.later(2.0)
    first, second = messages_of(play, SetBreakpoints)
    for asked in (first, second):
        error = {"code": "bad_breakpoint", "message": "-"}
        play.child_says("application", "answer", request=asked.request, error=error)
    assert play.reply(newer) == "bad_breakpoint"
    again = messages_of(play, SetBreakpoints)[2:]
    assert [(each.request, each.wanted) for each in again] == [(None, first.wanted)]
    assert play.session.hold.breakpoints == play.session.hold.given == first.wanted


def test_breakpoints_that_are_refused_after_a_hold_has_ended_switch_nothing_on() -> None:
    play = held()
    play.command("set_breakpoints")
    play.later(play.session.about.hold_limit_s + 1)
    assert play.state is State.APPLICATION_RUNNING
    play.obedient = False
    wrong = play.command("set_breakpoints", breakpoints=[{"tree_id": "Main", "node_id": "n2"}])
    asked = messages_of(play, SetBreakpoints)[-1].request
    play.child_says("application", "answer", request=asked, error={"code": "bad_breakpoint", "message": "-"})
    assert play.reply(wrong) == "bad_breakpoint"
    kept = play.session.hold.breakpoints
    assert kept is not None
    assert ([each.node_id for each in kept.breakpoints], kept.on) == (["n1"], False)


def test_breakpoints_that_the_tree_refuses_leave_those_before() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.command("set_breakpoints")
    play.obedient = False
    wrong = play.command("set_breakpoints", breakpoints=[{"tree_id": "Main", "node_id": "n2"}])
    asked = messages_of(play, SetBreakpoints)[-1].request
    play.child_says("application", "answer", request=asked, error={"code": "bad_breakpoint", "message": "-"})
    assert play.reply(wrong) == "bad_breakpoint"
    play.obedient = True
    play.command("restart_application")
    assert begun_with(play) == ["n1"]


def test_a_hold_that_lasts_too_long_ends_with_a_notice() -> None:
    play = held()
    play.command("set_breakpoints")
    limit_s = play.session.about.hold_limit_s
    assert play.session.deadline_s is not None
    play.later(limit_s - 1)
    assert play.state is State.HELD
    play.later(2)
    assert play.state is State.APPLICATION_RUNNING
    assert "held for 15 min" in play.sent("log")[-1].text
    assert play.sent("released")[-1].off
    assert play.session.hold.breakpoints is not None
    assert not play.session.hold.breakpoints.on


def test_a_driver_that_stays_away_leaves_a_paused_run_without_breakpoints() -> None:
    play = held()
    play.happens(ClientLeft("d"))
    play.later(HOLD_DRIVER_GRACE_S - 1)
    assert play.state is State.HELD
    play.later(2)
    assert play.state is State.PAUSED
    [last] = [m for m in messages_of(play, Continue) if m.off]
    assert last.pauses
    assert "was away" in play.sent("log")[-1].text


def test_a_driver_that_comes_back_in_time_finds_the_tree_held() -> None:
    play = held()
    play.happens(ClientLeft("d"))
    play.later(HOLD_DRIVER_GRACE_S / 2)
    play.happens(ClientJoined("d"))
    play.later(HOLD_DRIVER_GRACE_S)
    assert play.state is State.HELD
    assert play.sent("snapshot", client="d")[-1].held.uid == 2


def test_viewers_see_the_stop_and_control_nothing() -> None:
    play = held()
    play.happens(ClientJoined("v"))
    assert play.sent("snapshot", client="v")[-1].held.why == HELD["why"]
    for command in (*STEPS, "continue_run", "set_breakpoints", "force", "release"):
        assert play.reply(play.command(command, client="v")) == "not_driver"
    assert play.state is State.HELD


def test_the_user_of_an_outside_robot_learns_that_it_keeps_moving() -> None:
    play = Play()
    play.command("run", **(DATA["run"] | {"universe": {"universe": "none"}}))
    play.child_says("application", "held", **HELD)
    assert play.sent("held")[-1].outside
    assert "keeps moving" in play.sent("log")[-1].text


@pytest.mark.parametrize("kind", ["world", "application"])
def test_a_child_that_dies_while_held_ends_the_hold(kind) -> None:
    play = held()
    play.child_dies(kind)
    assert play.state is (State.CONNECTED if kind == "world" else State.VISUALIZATION_READY)
    snapshot = play.session.snapshot()
    assert (snapshot.held, snapshot.forced) == (None, None)
    assert play.reply(play.command("run")) == "ack"


def test_random_plays_with_stops_keep_to_the_table() -> None:
    """At any moment the application may say that it is held; then every command is tried."""
    seed = int(os.environ.get("BT_STUDIO_SEED", "0")) or random.randrange(1 << 30)  # noqa: S311
    sys.stdout.write(f"seed {seed}\n")
    chance = random.Random(seed)  # noqa: S311
    commands = [name for name in TABLE if name not in ("read_recording", "evaluate", "flag", "cancel")]
    for _ in range(count("session_holds")):
        play = Play()
        play.climb(State.APPLICATION_RUNNING)
        for _ in range(20):
            before = play.state
            if before is State.APPLICATION_RUNNING and chance.random() < 0.7:
                play.child_says("application", "held", **HELD)
                assert play.state is State.HELD
                before = play.state
            name = chance.choice(commands)
            reply = play.reply(play.command(name))
            if not is_legal(before, name):
                assert (reply, play.state) == ("wrong_state", before), name
            elif before is State.HELD and name in STEPS:
                assert (reply, play.state) == ("ack", State.HELD), name
                play.child_says("application", chance.choice(["held", "released"]), **HELD)
            elif before is State.HELD and name not in (*ENDS, "continue_run", "run_application"):
                assert play.state is State.HELD, name
            has_world_stopped = "resume" not in play.told("world")[-1:]
            assert play.state is not State.HELD or has_world_stopped, name
            held_event = play.session.snapshot().held
            assert (held_event is not None) is (play.state is State.HELD), name
