"""*Try many* in the session: its process, its outcomes, and its refusals."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from executor import messages
from executor.child_messages import Awake, KeepSnapshots, NewSeed, SetPort, StartApplication, TryMany
from executor.session.events import ChildLooked, DropSnapshot, Kill, Send, WakeSnapshot
from executor.session.exact.trying import SILENT_S
from executor.session.ladder import State
from tests.executor.session.exact.test_going_back import recorded
from tests.executor.session.exact.test_hosting import running, told
from tests.executor.session.exact.test_snapshots import taken
from tests.executor.session.play import UNIVERSE, Play

ASKED: dict[str, Any] = {
    "job": "a1",
    "node_id": "n1",
    "path": "Act::1",
    "port": "gain",
    "values": ["2", None],
    "t": 1.5,
}


def heard(play: Play) -> list[tuple[str, Any]]:
    """Returns the events of jobs that the driver got, with their names."""
    sent = [
        each for each in play.effects if isinstance(each, Send) and each.name.startswith(("trying_", "try_"))
    ]
    assert all(each.client == "d" for each in sent)
    return [(each.name, each.payload) for each in sent]


def outcome(play: Play, index: int, **more: Any) -> None:
    play.child_says("trying", "try_outcome", job="a1", index=index, end="running", **more)


def lives(play: Play) -> bool:
    return play.session.children.get("trying") is not None


def test_a_process_of_its_own_makes_the_run_again_and_tries() -> None:
    play = recorded()
    assert play.reply(play.command("try_values", **ASKED)) == "ack"
    assert play.state is State.APPLICATION_RUNNING
    start, order = told(play, "trying")
    assert isinstance(start, StartApplication)
    assert start.replay is not None
    assert (start.replay.until_s, start.replay.fingerprints) == (1.5, b"12345678" * 3)
    assert order == TryMany(
        "a1",
        [SetPort(node_id="n1", path="Act::1", port="gain", value=value) for value in ("2", None)],
        10.0,
    )
    play.child_says("trying", "trying_started", job="a1", t=1.5, at_once=1, outlines=[[[0, 0], [1, 0]]])
    for index in (0, 2, 1):
        outcome(play, index)
    play.child_says("trying", "trying_ended", job="a1", end="complete")
    names = [name for name, _ in heard(play)]
    assert names == ["trying_started", "try_outcome", "try_outcome", "try_outcome", "trying_ended"]
    assert heard(play)[-1][1] == messages.TryingEnded("a1", "complete")
    assert not lives(play)
    assert play.session.children.get("application") is not None


def test_seeds_are_tried_as_values_are() -> None:
    play = recorded()
    assert play.reply(play.command("try_seeds", job="a1", seeds=[7, 8], t=1.5, duration_s=4.0)) == "ack"
    start, order = told(play, "trying")
    assert isinstance(start, StartApplication)
    assert order == TryMany("a1", [NewSeed(7), NewSeed(8)], 4.0)
    for index in range(4):
        outcome(play, index)
    play.child_says("trying", "trying_ended", job="a1", end="complete")
    assert [name for name, _ in heard(play)] == ["try_outcome"] * 3 + ["trying_ended"]


@pytest.mark.parametrize("seeds", [[], [-1], [2**32], list(range(51))])
def test_seeds_outside_of_the_bounds_are_refused(seeds: list[int]) -> None:
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert({"job": "a1", "seeds": seeds}, messages.TrySeeds)


def test_the_newest_snapshot_before_the_moment_is_used_and_makes_none() -> None:
    play = recorded()
    taken(play, 1)
    play.command("try_values", **ASKED)
    (wake,) = [each for each in play.effects if isinstance(each, WakeSnapshot)]
    assert (wake.snapshot, wake.kind) == (1, "trying")
    awake, keep = told(play, "trying")
    assert isinstance(awake, Awake)
    assert keep == KeepSnapshots(is_on=False)
    play.child_says(
        "trying", "snapshot_taken", number=7, t=1.0, ticks=1, inputs=0, resets=0, is_at_tick=True, cost_s=1.0
    )
    dropped = [each for each in play.effects if isinstance(each, DropSnapshot)]
    assert dropped[-1] == DropSnapshot(wake.number, 7)
    play.child_dies("trying")  # it cannot be used: the run is made again from its begin
    assert isinstance(told(play, "trying")[2], StartApplication)
    assert isinstance(told(play, "trying")[3], TryMany)


def test_what_the_process_says_is_not_trusted() -> None:
    play = recorded()
    play.command("try_values", **ASKED)
    path = [[0.1 * at, 0.0, 0.0] for at in range(5000)]
    outcome(play, 0, message="x" * 9000, paths={str(at): path for at in range(20)})
    for index in (0, -1, 3, 99):
        outcome(play, index)
    play.child_says("trying", "trying_started", job="b2", t=1.5, at_once=1, outlines=[[]] * 9000)
    play.child_says("trying", "finished", status="SUCCESS", reason="root_finished")
    (_, first), (_, started) = heard(play)
    assert len(first.message) == 2000
    assert len(first.paths) == 8
    assert all(len(each) == 400 for each in first.paths.values())
    assert (started.job, len(started.outlines)) == ("a1", 500)
    assert play.state is State.APPLICATION_RUNNING
    play.child_says("trying", "trying_ended", job="b2", end="complete")
    assert heard(play)[-1][1].end == "failed"  # two outcomes are missing


def test_a_job_is_stopped_and_another_one_takes_its_place() -> None:
    play = recorded()
    play.command("try_values", **ASKED)
    play.command("stop_trying", job="ff")
    assert lives(play)
    assert play.reply(play.command("stop_trying", job="a1")) == "ack"
    assert not lives(play)
    assert [each.kind for each in play.effects if isinstance(each, Kill)][-1] == "trying"
    assert heard(play)[-1][1] == messages.TryingEnded("a1", "cancelled")
    play.command("try_values", **ASKED)
    play.command("try_values", **{**ASKED, "job": "b2"})
    assert [event.job for name, event in heard(play) if name == "trying_ended"] == ["a1", "a1"]
    assert lives(play)
    assert play.reply(play.command("disconnect")) == "ack"
    assert not lives(play)


def test_a_process_that_dies_is_silent_or_cannot_load_ends_its_job() -> None:
    play = recorded()
    play.command("try_values", **ASKED)
    play.child_dies("trying", "was killed by SIGKILL", "last words")
    assert heard(play)[-1][1] == messages.TryingEnded(
        "a1", "failed", "Its process was killed by SIGKILL.\nlast words"
    )
    assert play.state is State.APPLICATION_RUNNING
    play.command("try_values", **ASKED)
    play.child_says("trying", "fault", kind="load", message="It differs.", hint="Go back.")
    assert heard(play)[-1][1] == messages.TryingEnded("a1", "failed", "It differs. Go back.")
    play.command("try_values", **ASKED)
    number = play.session.children.living["trying"].number
    play.now += SILENT_S - 1
    play.happens(ChildLooked("trying", number, "R", 0.25, 0.0))
    assert lives(play)
    play.now += 2
    play.happens(ChildLooked("trying", number, "R", 0.25, 0.0))
    assert not lives(play)
    assert heard(play)[-1][1].end == "failed"


def test_runs_that_cannot_be_made_again_are_refused() -> None:
    play = Play()
    assert play.reply(play.command("try_values")) == "no_run"
    play = recorded()
    assert play.reply(play.command("try_values", **{**ASKED, "run": "nobody"})) == "unknown_run"
    play.session.past.find("").refusal = "It is too long"
    assert play.reply(play.command("try_values", **ASKED)) == "not_repeatable"
    live = running(universe=UNIVERSE)
    assert live.reply(live.command("try_values", **ASKED)) == "live_run"
    assert not lives(live)


@pytest.mark.parametrize(
    "change",
    [
        {"values": []},
        {"values": ["1"] * 51},
        {"values": ["x" * 5000]},
        {"values": [1]},
        {"duration_s": 0},
        {"duration_s": 1e9},
        {"t": -1.0},
        {"port": ""},
        {"job": "../etc"},
        {"more": 1},
    ],
)
def test_wrong_commands_are_not_read(change: dict[str, Any]) -> None:
    with pytest.raises(msgspec.ValidationError):
        msgspec.convert({**ASKED, **change}, messages.TryValues)
