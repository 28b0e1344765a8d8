"""The end of a process leads to the highest state that still holds."""

from __future__ import annotations

import pytest

from executor.session import child_exits
from executor.session.ladder import State
from tests.executor.session.play import Play


@pytest.mark.parametrize(
    ("kind", "state"), [("world", State.CONNECTED), ("application", State.VISUALIZATION_READY)]
)
def test_a_process_that_dies_is_reported_and_the_ladder_descends(kind: str, state: State) -> None:
    play = Play()
    play.climb(State.APPLICATION_RUNNING)
    play.child_dies(kind, "was killed by SIGKILL", "last words")  # type: ignore[arg-type]
    assert play.state is state
    [fault] = play.sent("fault")
    assert (fault.kind, fault.traceback) == ("process", "last words")
    assert [finished.reason for finished in play.sent("finished")] == ["process_died"]
    assert set(child_exits.__all__) == {"exited", "lose"}


def test_a_spare_that_dies_changes_nothing() -> None:
    play = Play()
    play.climb(State.CONNECTED)
    play.session.children.replenish()
    play.child_dies("application")
    assert play.state is State.CONNECTED
    assert play.sent("fault") == []
