"""The source of a past tick in the session: its process, its answer, and its refusals."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from executor import messages
from executor.child_messages import Awake, KeepSnapshots, StartApplication
from executor.messages import SourceCall, SourceProgress, TickSource
from executor.session.events import ChildLooked, Send, WakeSnapshot
from executor.session.exact.aside import SILENT_S
from executor.session.exact.sources import MOST_BYTES
from executor.session.ladder import State
from tests.executor.session.exact.test_going_back import recorded
from tests.executor.session.exact.test_hosting import running, told
from tests.executor.session.exact.test_snapshots import taken
from tests.executor.session.play import UNIVERSE, Play

CALL: dict[str, Any] = {
    "file": "actions/Act.py",
    "function": "Act.update",
    "line": 3,
    "uid": 2,
    "path": "Act::2",
    "part": "tick",
}


def heard(play: Play) -> list[Any]:
    """Returns what the driver gets of sources."""
    sent = [
        each
        for each in play.effects
        if isinstance(each, Send) and each.name in ("tick_source", "source_progress")
    ]
    assert all(each.client == "d" for each in sent)
    return [each.payload for each in sent]


def asked(job: str = "a1", t: float = 1.5) -> Play:
    play = recorded()
    assert play.reply(play.command("source_of_tick", job=job, t=t)) == "ack"
    return play


def lives(play: Play) -> bool:
    return play.session.children.get("source") is not None


def test_a_process_of_its_own_makes_the_run_again_and_ends() -> None:
    play = asked()
    (start,) = told(play, "source")
    assert isinstance(start, StartApplication)
    assert start.replay is not None
    assert (start.replay.until_s, start.replay.shows_source) == (1.5, True)
    assert not start.is_debugged
    play.child_says("source", "going_back", fraction=7.0)
    play.child_says("source", "differs", tick=2, t=0.1, cause="the clock")
    play.child_says("source", "tick_source", job="b2", t=1.5, tick=3, calls=[CALL], problem="none")
    progress, found = heard(play)
    assert progress == SourceProgress("a1", 1.0)
    assert found == TickSource("a1", 1.5, 3, [msgspec.convert(CALL, SourceCall)], differs=2)
    assert not lives(play)
    assert play.state is State.APPLICATION_RUNNING
    assert play.session.children.get("application") is not None
    assert not told(play, "source")[1:]


def test_only_a_snapshot_from_before_the_tick_is_used() -> None:
    play = recorded()
    taken(play, 1)
    snapshot = play.session.snapshots._there[0].taken.t
    play.command("source_of_tick", job="a1", t=snapshot)
    assert [each for each in play.effects if isinstance(each, WakeSnapshot)] == []
    play.command("source_of_tick", job="a1", t=snapshot + 0.05)
    (wake,) = [each for each in play.effects if isinstance(each, WakeSnapshot)]
    assert wake.kind == "source"
    awake, keep = told(play, "source")[-2:]
    assert isinstance(awake, Awake)
    assert awake.replay.shows_source
    assert keep == KeepSnapshots(is_on=False)
    play.child_dies("source")  # it cannot be used: the run is made again from its begin
    assert isinstance(told(play, "source")[-1], StartApplication)
    assert lives(play)


def test_a_process_that_dies_is_silent_or_has_no_such_tick_says_why() -> None:
    play = asked()
    play.child_dies("source", "was killed by SIGSEGV", "last words")
    assert heard(play)[-1].problem == "Its process was killed by SIGSEGV.\nlast words"
    play = asked()
    play.child_says("source", "fault", kind="load", message="It differs.", hint="Go back.")
    assert heard(play)[-1].problem == "It differs. Go back."
    play = asked()
    play.child_says("source", "ready")
    assert "no tick at this moment" in heard(play)[-1].problem
    play = asked()
    number = play.session.children.living["source"].number
    play.now += SILENT_S + 1
    play.happens(ChildLooked("source", number, "R", 0.25, 0.0))
    assert "no longer makes progress" in heard(play)[-1].problem
    assert not lives(play)
    play = asked()
    play.child_says("source", "tick_source", job="a1", files={"actions/Act.py": "x" * MOST_BYTES})
    assert "too much" in heard(play)[-1].problem
    assert not lives(play)


def test_a_job_is_stopped_and_another_one_takes_its_place() -> None:
    play = asked()
    play.command("stop_source", job="ff")
    assert lives(play)
    assert play.reply(play.command("stop_source", job="a1")) == "ack"
    assert not lives(play)
    assert heard(play) == [TickSource("a1", problem="It was stopped.")]
    play.command("source_of_tick", job="b2", t=1.0)
    play.command("source_of_tick", job="c3", t=1.2)
    assert [each.job for each in heard(play)] == ["a1", "b2"]
    play.command("try_values")  # both run beside each other
    assert lives(play)
    assert play.session.children.get("trying") is not None
    assert play.reply(play.command("disconnect")) == "ack"
    assert not lives(play)


def test_runs_that_cannot_be_made_again_are_refused() -> None:
    play = Play()
    assert play.reply(play.command("source_of_tick")) == "no_run"
    play = recorded()
    assert play.reply(play.command("source_of_tick", job="a1", t=1.5, run="nobody")) == "unknown_run"
    play.session.past.find("").refusal = "It is too long"
    assert play.reply(play.command("source_of_tick")) == "not_repeatable"
    live = running(universe=UNIVERSE)
    assert live.reply(live.command("source_of_tick")) == "live_run"
    assert not lives(live)


def test_ticks_after_a_change_by_the_debugger_are_refused() -> None:
    play = recorded()
    play.session.past.changed_by_hand(1.0, 20)
    play.session.past.changed_by_hand(4.0, 80)
    assert play.reply(play.command("source_of_tick", job="a1", t=1.0)) == "changed_by_hand"
    assert play.reply(play.command("source_of_tick", job="a1", t=0.95)) == "ack"


@pytest.mark.parametrize("change", [{"job": "../etc"}, {"t": -1.0}, {"t": None}, {"more": 1}])
def test_wrong_commands_are_not_read(change: dict[str, Any]) -> None:
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert({"job": "a1", "t": 1.5, **change}, messages.SourceOfTick)
