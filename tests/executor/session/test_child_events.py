"""Messages of children as events for clients."""

from __future__ import annotations

from executor.child_messages import Log
from executor.session import child_events
from executor.session.child import Child
from executor.session.events import ChildSaid
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
    play.climb(State.UNIVERSE_READY)
    for kind, source in (("application", "action"), ("world", "world")):
        said = ChildSaid(kind, 1, Log("info", "hello"))  # type: ignore[arg-type]
        child_events.forward(play.session, Child("world", 1), said)  # type: ignore[arg-type]
        assert source
