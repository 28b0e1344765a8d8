"""A process beside the ladder that makes a run again: what it begins with, and when it counts as lost."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.child_messages import Awake, StartApplication
from executor.session.exact.aside import SILENT_S, Aside
from tests.executor.session.exact.test_going_back import recorded
from tests.executor.session.exact.test_hosting import told
from tests.executor.session.exact.test_snapshots import taken

if TYPE_CHECKING:
    from tests.executor.session.play import Play


def begun(play: Play, after_s: float | None) -> Aside:
    aside = Aside(play.session, "source")
    past = play.session.past.find("")
    assert past is not None
    aside.begin(past, past.replay(9.0), after_s)
    play.effects += play.session.output.take()
    return aside


def test_it_begins_as_a_copy_of_a_snapshot_that_is_not_too_late() -> None:
    play = recorded()
    taken(play, 1)
    begun(play, 9.0)
    assert isinstance(told(play, "source")[0], Awake)
    play = recorded()
    taken(play, 1)
    begun(play, 0.0)
    (start,) = told(play, "source")
    assert isinstance(start, StartApplication)
    assert not start.is_debugged


def test_it_is_silent_after_a_while_without_progress() -> None:
    play = recorded()
    aside = begun(play, None)
    now_s = play.session.now_s
    assert not aside.is_silent(now_s + SILENT_S)
    assert aside.is_silent(now_s + SILENT_S + 1)
    aside.end()
    assert not aside.is_silent(now_s + SILENT_S + 1)
    assert not aside.is_there
