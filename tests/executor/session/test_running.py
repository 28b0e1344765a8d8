"""Commands that concern a run under way."""

from __future__ import annotations

from executor.session import running
from executor.session.events import Interrupt
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
