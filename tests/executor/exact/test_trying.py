"""*Try many* with real processes: each value is what the run itself would have done with it."""

from __future__ import annotations

import os
import signal
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

import psutil
import pytest

from executor import child_messages
from executor.child_messages import NewSeed, SetPort, TryingEnded, TryingStarted, TryMany, TryOutcome
from executor.exact import trying
from executor.exact.trying import Trying, most_at_once
from executor.replay_messages import FINGERPRINT_BYTES, Replay
from tests.executor.exact.exact_runs import ExactRun, app_folder, start_message
from tests.executor.exact.test_going_back import bump_and_go
from tests.executor.exact.test_process import exact, ready
from tests.executor.warm import warm_session

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

pytestmark = pytest.mark.simulation

MOMENT_S = 2.0
TICKS = 40
VALUES = ("0.3", "0.05", "0.6", "fast", "0.9")


def forks(continue_with: Callable[..., TryOutcome], count: int = 2) -> list[Any]:
    """Runs a job whose continuations do something else."""
    said: list[Any] = []
    changes = [SetPort(node_id="n1", path="Act::1", port="gain", value="1")] * (count - 1)
    Trying("a1", changes, send=said.append, moved=lambda: None, continue_with=continue_with).run()
    assert said[-1] == TryingEnded("a1", "complete")
    return [each for each in said if isinstance(each, TryOutcome)]


def test_a_continuation_that_raises_or_ends_is_one_row() -> None:
    def bad(index: int, change: SetPort | None, tell: Callable[[float], None]) -> TryOutcome:
        tell(0.5)
        if change is None:
            os.kill(os.getpid(), signal.SIGKILL)
        if index == 1:
            raise ValueError("boo")
        return TryOutcome("another", 77, "running", ticks=index)

    outcomes = {each.index: each for each in forks(bad, 3)}
    assert [outcomes[index].end for index in range(3)] == ["died", "died", "running"]
    assert "ended at once" in outcomes[0].message
    assert "exit code 1" in outcomes[1].message
    assert (outcomes[2].job, outcomes[2].ticks) == ("a1", 2)


def test_a_tick_that_does_not_return_is_ended(monkeypatch: pytest.MonkeyPatch) -> None:
    def waits(index: int, _: SetPort | None, tell: Callable[[float], None]) -> TryOutcome:
        if index == 0:
            signal.pause()
        return TryOutcome("a1", index, "running")

    monkeypatch.setattr(trying, "SILENT_S", 3.0)  # enough for the fork that answers
    outcomes = {each.index: each for each in forks(waits)}
    assert (outcomes[0].end, outcomes[1].end) == ("late", "running")
    assert most_at_once() >= 1


def forward(run: ExactRun, value: str | None, port: str = "lin_speed") -> SetPort:
    """Returns the order that gives the port of *Forward* a value."""
    (tree, *_) = run.said_of(child_messages.Tree)
    node = next(each for each in tree.nodes if each.type == "Forward")
    return SetPort(node_id=node.node_id, path=node.path, port=port, value=value)


def tried(run: ExactRun, changes: list[SetPort | NewSeed], duration_s: float = 2.0) -> dict[int, TryOutcome]:
    run.tell(TryMany("a1", changes, duration_s))
    ended = run.until(lambda m: isinstance(m, TryingEnded))
    assert (ended.end, ended.message) == ("complete", "")
    return {each.index: each for each in run.said_of(TryOutcome)}


@pytest.fixture(scope="module")
def past() -> Iterator[tuple[Path, Replay]]:
    """A run of a few seconds, with an input before the moment."""
    with app_folder() as folder:
        run = ExactRun(start_message(folder))
        run.run_ticks(10)
        run.tell(child_messages.ForWorld(child_messages.Teleop(0.1, 0.4)))
        run.run_ticks(110)
        run.end()
        assert len(run.prints) > 100 * FINGERPRINT_BYTES
        yield folder, Replay(run.inputs, bytes(run.prints), MOMENT_S)


def at_moment(past: tuple[Path, Replay]) -> ExactRun:
    folder, replay = past
    return ExactRun(start_message(folder, replay=replay))


def test_values_give_other_courses_and_the_same_value_the_same_run(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    outcomes = tried(run, [forward(run, value) for value in VALUES])
    (started,) = run.said_of(TryingStarted)
    assert started.t == pytest.approx(MOMENT_S, abs=0.06)
    assert len(started.outlines) >= 4  # the walls of the room
    assert sorted(outcomes) == [0, 1, 2, 3, 4, 5]
    assert outcomes[0].as_before is True
    assert outcomes[0].fingerprint == outcomes[1].fingerprint
    assert outcomes[0].paths == outcomes[1].paths
    assert outcomes[4].end == "refused"
    assert "lin_speed" in outcomes[4].message
    assert outcomes[4].ticks == 0
    others = [outcomes[index] for index in (1, 2, 3, 5)]
    assert len({each.fingerprint for each in others}) == 4
    assert [each.as_before for each in others] == [True, False, False, False]
    for each in others:
        assert each.end == "running"
        assert each.ticks == TICKS
        (path,) = each.paths.values()
        assert path[0][1:] == next(iter(outcomes[0].paths.values()))[0][1:]
    assert outcomes[2].distance_m < outcomes[0].distance_m < outcomes[5].distance_m
    run.end()


def test_the_seed_of_the_run_gives_the_run_and_others_another_course(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    outcomes = tried(run, [NewSeed(3), NewSeed(11), NewSeed(12), NewSeed(11)])
    assert {each.end for each in outcomes.values()} == {"running"}
    as_it_is, own, one, other, again = (outcomes[index] for index in range(5))
    assert (own.fingerprint, own.paths, own.as_before) == (as_it_is.fingerprint, as_it_is.paths, True)
    assert len({own.fingerprint, one.fingerprint, other.fingerprint}) == 3
    assert (one.as_before, other.as_before) == (False, False)
    assert (again.fingerprint, again.paths) == (one.fingerprint, one.paths)
    run.end()


def test_a_branch_with_the_value_is_what_was_tried(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    outcome = tried(run, [forward(run, "0.6")])[1]
    run.prints.clear()
    run.tell(forward(run, "0.6"))
    for _ in range(TICKS):
        run.tell(child_messages.StepTick())
    for _ in range(TICKS):
        run.until(lambda m: isinstance(m, child_messages.Stepped))
    run.end()

    prints = bytes(run.prints[: TICKS * FINGERPRINT_BYTES])
    assert blake2b(prints, digest_size=FINGERPRINT_BYTES).hexdigest() == outcome.fingerprint


def test_what_has_no_such_port_or_node_is_refused_and_the_run_stands(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    nowhere = SetPort(node_id="n99", path="Nowhere::9", port="lin_speed", value="1")
    outcomes = tried(run, [forward(run, "1", "wings"), nowhere, forward(run, None)], 0.5)
    assert outcomes[1].end == outcomes[2].end == "refused"
    assert "wings" in outcomes[1].message
    assert "Nowhere::9" in outcomes[2].message
    again = tried(run, [], 0.5)
    assert again[0].fingerprint == outcomes[0].fingerprint
    run.end()


def test_a_continuation_that_is_killed_is_one_row(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    run.tell(TryMany("a1", [forward(run, "0.5")], 100.0))
    run.until(lambda m: isinstance(m, child_messages.TryingProgress) and m.fraction > 0)
    (copy, *_) = psutil.Process(run.process.pid).children()
    os.kill(copy.pid, signal.SIGKILL)
    run.until(lambda m: isinstance(m, TryOutcome))
    (outcome,) = run.said_of(TryOutcome)
    assert (outcome.end, outcome.index) == ("died", 0)
    assert "ended at once" in outcome.message
    run.process.kill()
    run.process.wait(30)
    run.kill()


def test_continuations_end_with_their_process(past: tuple[Path, Replay]) -> None:
    run = at_moment(past)
    run.tell(TryMany("a1", [forward(run, "0.5")], 100.0))
    run.until(lambda m: isinstance(m, child_messages.TryingProgress) and m.fraction > 0)
    copies = psutil.Process(run.process.pid).children()
    assert copies
    run.kill()
    gone, alive = psutil.wait_procs(copies, timeout=30)
    assert (len(gone), alive) == (len(copies), [])


def test_the_fault_of_a_continuation_is_reported() -> None:
    with app_folder("        if self.number == 60: raise ValueError('too far')\n") as folder:
        run = ExactRun(start_message(folder))
        run.run_ticks(5)
        run.pause_after_tick()
        outcome = tried(run, [], 20.0)[0]
        assert outcome.end == "fault"
        assert "too far" in outcome.message
        assert "Forward.py" in outcome.message
        run.end()


async def test_a_session_tries_values_from_before_the_touch_of_a_crate() -> None:
    async with warm_session() as (_, client):
        near = exact(bump_and_go("0.3"))
        near["universe"]["speed"] = 0.0
        at = await ready(client, near)
        node = next(each for each in client.named("tree", at)[-1]["nodes"] if each["type"] == "CheckObstacle")
        log = await client.event("log", lambda d: "bumped into" in d["text"], after=at)
        touched_s = log["data"]["time"]
        assert await client.ask("pause") == "ack"

        at = len(client.events)
        order = {
            "job": "a1",
            "node_id": node["node_id"],
            "path": node["path"],
            "port": "obs_dist",
            "values": ["0.3", "1.2", "near"],
            "duration_s": 5.0,
            "t": touched_s - 3.0,
        }
        wrong: list[dict[str, Any]] = [{"values": []}, {"values": ["1"] * 51}, {"duration_s": 1e9}]
        for bad in (*wrong, {"job": "-"}):
            assert (await client.ask("try_values", {**order, **bad}))["code"] == "bad_data"
        assert (await client.ask("try_values", {**order, "run": "ffffffffffff"}))["code"] == "unknown_run"
        assert await client.ask("try_values", order) == "ack"
        ended = await client.event("trying_ended", after=at)
        assert ended["data"]["end"] == "complete"
        found = {each["index"]: each for each in client.named("try_outcome", at)}
        assert [found[index]["end"] for index in range(4)] == ["running"] * 3 + ["refused"]
        for same in (found[0], found[1]):
            assert same["as_before"] is True
            assert same["crash"]["t"] == pytest.approx(touched_s, abs=0.3)
        assert (found[2]["crash"], found[2]["collisions"], found[2]["as_before"]) == (None, 0, False)
        assert client.state == "paused"
        assert client.named("branch", at) == []
        assert client.named("tick", at) == []  # nothing happened in the world of the session

        at = len(client.events)
        assert await client.ask("try_values", {**order, "duration_s": 120.0}) == "ack"
        await client.event("trying_progress", lambda d: d["stage"] == "continuing", after=at)
        assert await client.ask("stop_trying", {"job": "a1"}) == "ack"
        assert (await client.event("trying_ended", after=at))["data"]["end"] == "cancelled"
        assert await client.ask("resume") == "ack"
        assert await client.ask("disconnect") == "ack"
