"""Commands that concern a run under way."""

from __future__ import annotations

import pytest

from executor.child_messages import Resume
from executor.session import running
from executor.session.events import ChildExited, Interrupt, Tell, Unpacked
from executor.session.ladder import State
from executor.session.running import ROUNDS_OF_PATIENCE, TICK_PATIENCE_S
from tests.executor.session.play import Play


def test_a_pause_stops_both_processes() -> None:
    play = Play()
    play.climb(State.PAUSED)
    for kind in ("world", "application"):
        assert play.told(kind)[-1] == "pause"
    assert play.reply(play.command("resume")) == "ack"
    assert play.state is State.APPLICATION_RUNNING


def test_a_step_ticks_once_and_simulates_one_period() -> None:
    play = Play()
    play.climb(State.PAUSED)
    assert play.reply(play.command("step")) == "ack"
    assert play.told("application")[-1] == "step"
    assert play.told("world")[-1] == "step"
    assert play.state is State.PAUSED


def test_a_tick_that_never_ends_is_interrupted() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.obedient = False
    play.command("pause")
    for _ in range(ROUNDS_OF_PATIENCE + 1):
        play.later(TICK_PATIENCE_S)
    assert play.did(Interrupt) == ["application"]
    assert "pause" in running.__all__


def first_tick_ends_the_run(play: Play, command: str) -> str:
    """The application ends its run before the world confirms that its time passes; returns the request."""
    play.obedient = False
    request = play.command(command)
    if command == "run":
        play.happens(Unpacked(1, "/somewhere"))
        play.child_says("world", "ready", renderer="egl", tf=True, universe="Walled room")
        play.child_says("application", "ready")
    play.child_says("application", "resumed")
    play.child_says("application", "fault", kind="exception", message="it has no child 7")
    play.child_says("application", "finished", status="FAILURE", reason="action_raised", message="It raised.")
    return request


def the_world_confirms(play: Play) -> None:
    """It answers the last order to resume."""
    orders = [
        effect.message.request
        for effect in play.effects
        if isinstance(effect, Tell) and effect.kind == "world" and isinstance(effect.message, Resume)
    ]
    play.child_says("world", "answer", request=orders[-1])


@pytest.mark.parametrize("exits_first", [True, False])
def test_a_run_that_its_first_tick_ends_is_over_and_has_one_fault(*, exits_first: bool) -> None:
    play = Play()
    request = first_tick_ends_the_run(play, "run")
    number = play.session.children.living["application"].number
    for happens in (
        lambda: play.happens(ChildExited("application", number, "ended with exit code 0")),
        lambda: the_world_confirms(play),
    )[:: 1 if exits_first else -1]:
        happens()
    assert play.reply(request) == "ack"
    assert play.state is State.VISUALIZATION_READY
    assert [fault.message for fault in play.sent("fault")] == ["it has no child 7"]
    assert [finished.reason for finished in play.sent("finished")] == ["action_raised"]
    assert play.sent("state-changed")[-1].reason == "It raised."
    assert play.session.children.living["application"].number != number, "there is a spare for the next run"


def test_a_resumed_run_that_its_first_tick_ends_stays_over() -> None:
    play = Play()
    play.climb(State.PAUSED)
    request = first_tick_ends_the_run(play, "resume")
    the_world_confirms(play)
    assert play.reply(request) == "ack"
    assert play.state is State.VISUALIZATION_READY


def test_a_resumed_run_whose_process_dies_meanwhile_is_over() -> None:
    play = Play()
    play.climb(State.PAUSED)
    play.obedient = False
    request = play.command("resume")
    play.child_says("application", "resumed")
    play.child_dies("application")
    the_world_confirms(play)
    assert play.reply(request) == "process_died"
    assert play.state is State.VISUALIZATION_READY
