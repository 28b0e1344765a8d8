"""Messages of children as events for clients."""

from __future__ import annotations

from executor.session import child_events
from executor.session.ladder import State
from tests.executor.session.play import Play


def test_a_tick_sets_the_time_and_reaches_all() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.child_says("application", "tick", n=1, t=2.5, changed=[], flashed=[], duration_ms=1.0)
    assert play.session.sim_time_s == 2.5
    assert [tick.n for tick in play.sent("tick")] == [1]


def test_a_line_has_its_source_and_the_simulated_time() -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.child_says("application", "tick", n=1, t=2.5, changed=[], flashed=[], duration_ms=1.0)
    play.child_says("application", "log", level="info", text="hello")
    play.child_says("world", "log", level="warning", text="slow")
    lines = [(line.source, line.text, line.time) for line in play.sent("log")]
    assert lines[-2:] == [("action", "hello", 2.5), ("world", "slow", 2.5)]
    assert set(child_events.__all__) == {"forward", "log"}
