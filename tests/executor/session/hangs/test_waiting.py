"""The action in which a tick takes long is shown before it counts as hanging, and no longer than it takes."""

from __future__ import annotations

import pytest

from executor.messages import Waiting
from executor.session.hangs.waiting import beat
from executor.session.ladder import State
from tests.executor.session.hangs.test_watch import ACTION, Watched, play_in

LONG = Waiting("A 'main/A'", "n1", "main/A")
NOTHING = Waiting()


@pytest.fixture
def play() -> Watched:
    return play_in(State.APPLICATION_RUNNING)


def shown(play: Watched) -> Waiting:
    snapshot = play.session.mirror.snapshot().waiting
    assert play.session.mirror.waiting == snapshot
    return snapshot


def test_a_long_tick_is_shown_until_it_returns(play: Watched) -> None:
    assert shown(play) == NOTHING
    play.place["application"] = ACTION
    play.goes_on(0.5)
    assert shown(play) == LONG
    assert play.sent("waiting") == [LONG], "it is sent once, not with each beat"
    del play.place["application"]
    play.goes_on(0.5)
    assert shown(play) == NOTHING
    assert play.sent("waiting") == [LONG, NOTHING]


def test_code_of_our_own_and_loading_are_not_shown(play: Watched) -> None:
    play.place["application"] = {"text": "executor/loop.py:3"}
    play.goes_on(0.5)
    assert shown(play) == NOTHING
    play.place["application"] = ACTION
    play.task["application"] = "loading"
    play.goes_on(0.5)
    assert shown(play) == NOTHING


def test_a_spare_says_nothing_of_the_run(play: Watched) -> None:
    spare = play.session.children.living["world"]
    beat(play.session, spare)
    assert play.sent("waiting") == []


def test_it_is_over_when_the_run_is(play: Watched) -> None:
    play.place["application"] = ACTION
    play.goes_on(0.5)
    play.child_dies("application")
    assert shown(play) == NOTHING
    assert play.sent("waiting") == [LONG], "clients know it from the state"
