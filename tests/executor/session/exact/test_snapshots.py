"""Snapshots in the session: which are kept, which one is woken, and what happens where that fails."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from executor import child_messages
from executor.session.events import (
    ChildExited,
    DropSnapshot,
    SnapshotEnded,
    SnapshotWeighed,
    Tell,
    WakeSnapshot,
)
from executor.session.exact.snapshots import TIP_S
from executor.session.ladder import State
from tests.executor.session.exact.test_going_back import recorded
from tests.executor.session.exact.test_hosting import RUN, started, told

if TYPE_CHECKING:
    from tests.executor.session.play import Play

WENT_BACK = {"t": 1.5, "ticks": 2, "inputs": 0, "resets": 0, "tick_hz": 20.0}


def taken(play: Play, number: int, **more: Any) -> None:
    fields = {
        "t": 0.1 * number,
        "ticks": 1,
        "inputs": 0,
        "resets": 0,
        "is_at_tick": True,
        "cost_s": float(number),
    }
    play.child_says("application", "snapshot_taken", number=number, **{**fields, **more})


def woken(play: Play, at: int = 0) -> list[WakeSnapshot]:
    return [effect for effect in play.effects[at:] if isinstance(effect, WakeSnapshot)]


def dropped(play: Play, at: int = 0) -> list[int]:
    return [effect.snapshot for effect in play.effects[at:] if isinstance(effect, DropSnapshot)]


def going_back(play: Play, **data: Any) -> str:
    """Sends the command; the copy of a snapshot says nothing yet."""
    request = play.command("go_back", **data)
    assert play.reply(request) is None
    return request


def arrive(play: Play, **more: Any) -> None:
    play.child_says("application", "starting")
    play.child_says("application", "went_back", **{**WENT_BACK, **more})
    play.child_says("application", "ready")


def test_the_newest_snapshot_before_the_moment_continues() -> None:
    play = recorded()
    number = play.session.children.living["application"].number
    taken(play, 1)
    taken(play, 2, t=1.4)
    taken(play, 3, t=2.0)
    request = going_back(play, t=1.5)
    (wake,) = woken(play)
    assert (wake.child, wake.snapshot) == (number, 2)
    (awake,) = [m for m in told(play, "application") if isinstance(m, child_messages.Awake)]
    assert awake.replay.until_s == 1.5
    arrive(play)
    assert play.reply(request) == "ack"
    assert play.state is State.PAUSED
    assert play.session.children.host is play.session.children.get("application")
    assert len(started(play)) == 1
    assert play.sent("branch")[-1].from_t == 1.5
    assert play.reply(play.command("resume")) == "ack"


@pytest.mark.parametrize(
    ("t", "is_at_tick", "is_used"), [(1.5, True, True), (1.5, False, False), (1.49, False, True)]
)
def test_a_snapshot_between_two_ticks_is_only_for_later_moments(
    t: float, is_at_tick: bool, is_used: bool
) -> None:
    play = recorded()
    taken(play, 1, t=t, is_at_tick=is_at_tick)
    play.command("go_back", t=1.5)
    assert bool(woken(play)) is is_used


def test_the_present_is_kept_and_continues_where_its_run_ended() -> None:
    play = recorded()
    run = play.session.recording.run
    play.obedient = False
    request = play.command("go_back", t=0.5)
    assert isinstance(told(play, "application")[-1], child_messages.TakeSnapshot)
    taken(play, 7, t=3.0, ticks=3, inputs=1, is_at_tick=False, is_wanted=True)
    play.obedient = True
    play.child_dies("application", "ended with exit code 0")
    assert play.reply(request) == "ack"
    assert woken(play) == []
    at = len(play.effects)
    back = going_back(play, run=run)
    assert [wake.snapshot for wake in woken(play, at)] == [7]
    arrive(play, t=3.0, ticks=3, inputs=1)
    assert play.reply(back) == "ack"


def test_a_present_that_does_not_answer_is_not_waited_for_long() -> None:
    play = recorded()
    play.obedient = False
    play.command("go_back", t=0.5)
    play.later(TIP_S + 0.1)
    assert any(isinstance(message, child_messages.Stop) for message in told(play, "application"))


def test_where_a_snapshot_fails_the_run_is_made_again_from_its_begin() -> None:
    play = recorded()
    taken(play, 1)
    request = going_back(play, t=1.5)
    play.child_dies("application", "could not be started: the snapshot has ended")
    assert play.reply(request) == "ack"
    assert len(started(play)) == 2
    assert "from its begin" in play.sent("log")[-2].text


def test_a_way_back_by_a_snapshot_can_be_cancelled() -> None:
    play = recorded()
    taken(play, 1)
    request = going_back(play, t=1.5)
    assert play.reply(play.command("cancel")) == "ack"
    assert play.reply(request) == "cancelled"
    assert play.reply(play.command("run", **RUN)) == "ack"


def test_a_snapshot_that_does_not_fit_to_what_is_known_is_dropped() -> None:
    play = recorded()
    taken(play, 1, ticks=99)
    taken(play, 2, inputs=99)
    assert dropped(play) == [1, 2]
    taken(play, 3)
    taken(play, 3)  # the same again
    assert dropped(play) == [1, 2, 3]


def test_snapshots_of_another_run_are_not_used() -> None:
    play = recorded()
    taken(play, 1)
    play.command("run", **RUN)
    play.child_says("application", "fingerprints", data=b"87654321" * 3)
    assert play.reply(play.command("go_back", t=1.5)) == "ack"
    assert woken(play) == []


def test_snapshots_end_with_the_world_and_when_memory_is_short() -> None:
    play = recorded()
    number = play.session.children.living["application"].number
    for each in (1, 2, 3):
        taken(play, each)
    play.happens(SnapshotEnded(number, 1))
    play.happens(SnapshotWeighed(number, 2, 5 << 20, -(20 << 20)))
    assert dropped(play) == [2, 3]
    told_to = [m for m in told(play, "application") if isinstance(m, child_messages.KeepSnapshots)]
    assert [message.is_on for message in told_to] == [True, False]
    assert "memory" in play.sent("log")[-1].text
    taken(play, 4)
    play.happens(SnapshotWeighed(number, 4, 1 << 20, 100 << 20))
    told_to = [m for m in told(play, "application") if isinstance(m, child_messages.KeepSnapshots)]
    assert told_to[-1].is_on
    play.command("disconnect")
    assert dropped(play) == [2, 3, 4]


def test_where_memory_is_short_a_future_that_was_left_goes_before_the_past_of_the_present() -> None:
    play = recorded()
    number = play.session.children.living["application"].number
    taken(play, 1, ticks=1)
    taken(play, 2, ticks=2, t=1.4)
    taken(play, 3, ticks=3, t=2.0)
    going_back(play, t=1.5)
    arrive(play)
    taken(play, 1, ticks=2, t=1.6, cost_s=2.5)
    for each in (1, 2, 3):
        assert dropped(play) == []
        play.happens(SnapshotWeighed(number, each, 90 << 20, None))
    assert dropped(play) == [3]


def test_a_reason_is_sent_once() -> None:
    play = recorded()
    for _ in range(3):
        play.child_says("application", "no_snapshots", reason="the thread “t” runs in it")
    play.child_says("application", "no_snapshots", reason="another", is_wanted=True)
    assert [log.text for log in play.sent("log") if "snapshots" in log.text] == [
        "No snapshots of this run are made: the thread “t” runs in it. "
        "Going back makes it again from an earlier one."
    ]


def test_a_late_exit_after_the_copy_has_taken_over_is_that_of_the_application() -> None:
    play = recorded()
    taken(play, 1)
    request = going_back(play, t=1.5)
    arrive(play)
    assert play.reply(request) == "ack"
    child = play.session.children.living["application"]
    play.happens(ChildExited("application", child.number, "was killed by SIGKILL"))
    assert play.state is State.VISUALIZATION_READY
    tells = [effect for effect in play.effects if isinstance(effect, Tell) and effect.kind == "world"]
    assert tells
