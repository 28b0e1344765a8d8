"""The session keeps of an exact run all that is needed to make it again."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest

from executor import child_messages
from executor.child_messages import Entered, Fingerprints, ForWorld, StartApplication, StartWorld, WentBack
from executor.replay_messages import Input
from executor.session.exact import past
from executor.session.exact.past import MOST_FOLDERS, MOST_RUNS, PastRun, PastRuns


def start(folder: str = "/app") -> StartApplication:
    return StartApplication(folder, 20.0, world=StartWorld("walled_room"))


def entered(message: Any, tick: int = 1) -> Entered:
    return Entered(Input(tick, 12 * tick, -1, msgspec.msgpack.encode(message)))


TELEOP = ForWorld(child_messages.Teleop(0.1, 0.2))


def test_a_run_is_made_again_with_what_it_had() -> None:
    runs = PastRuns()
    runs.begin(start())
    runs.name("abc")
    runs.said(entered(TELEOP))
    runs.said(Fingerprints(b"12345678"))
    runs.said(Fingerprints(b"abcdefgh"))
    run = runs.find("abc")
    assert run is not None
    assert run is runs.find("")
    replay = run.replay(2.5)
    assert replay.inputs == [entered(TELEOP).input]
    assert (replay.fingerprints, replay.until_s, replay.resets) == (b"12345678abcdefgh", 2.5, 0)
    runs.said(entered(TELEOP))
    assert len(replay.inputs) == 1  # it does not change any more


@pytest.mark.parametrize("message", [b"", b"\xff", b"\xc1\x00", msgspec.msgpack.encode({"type": "unknown"})])
def test_a_run_whose_inputs_are_rubbish_is_not_made_again(message: bytes) -> None:
    runs = PastRuns()
    runs.begin(start())
    runs.name("abc")
    runs.said(Entered(Input(1, 12, -1, message)))
    run = runs.find("abc")
    assert run is not None
    assert (run.refusal, run.inputs) == (past.DAMAGED, [])
    runs.said(entered(TELEOP))
    assert run.inputs == []


def test_many_small_inputs_take_no_more_memory_than_few_large_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(past, "MOST_INPUT_BYTES", 100 * past.OWN_BYTES)
    run = PastRun(start())
    for tick in range(100):
        run.enter(entered(TELEOP, tick))
    assert (run.refusal, run.inputs) == (past.TOO_MUCH, [])


def test_a_branch_has_what_was_before_its_moment() -> None:
    runs = PastRuns()
    runs.begin(start())
    runs.name("abc")
    for tick in (1, 2, 3):
        runs.said(entered(TELEOP, tick))
        runs.said(Fingerprints(bytes([tick]) * 8))
    parent = runs.find("abc")
    assert parent is not None
    runs.branch(parent, WentBack(0.1, 2, 1, 0, 20.0))
    runs.name("def")
    runs.said(Fingerprints(b"new tick"))
    branch = runs.find("def")
    assert branch is not None
    assert [kept.tick for kept in branch.inputs] == [1]
    assert bytes(branch.fingerprints) == bytes([1]) * 8 + bytes([2]) * 8 + b"new tick"
    assert len(parent.inputs) == 3
    assert len(parent.fingerprints) == 24
    assert runs.find("") is branch


def test_a_branch_that_takes_the_place_of_another_pushes_no_run_out() -> None:
    runs = PastRuns()
    for number in range(MOST_RUNS):
        runs.begin(start())
        runs.name(str(number))
    parent = runs.find("0")
    assert parent is not None
    runs.branch(parent, WentBack(0.0, 0, 0, 0, 20.0), instead_of=str(MOST_RUNS - 1))
    runs.name("branch")
    assert runs.names == [*map(str, range(MOST_RUNS - 1)), "branch"]
    runs.branch(parent, WentBack(0.0, 0, 0, 0, 20.0))
    assert runs.find("0") is None


@pytest.mark.parametrize(("ticks", "is_part"), [(0, True), (2, True), (3, False)])
def test_a_branch_is_a_part_of_its_parent_in_its_first_ticks(ticks: int, is_part: bool) -> None:
    run = PastRun(start(), fingerprints=bytearray(b"1" * 8 + b"2" * 8 + b"3" * 8))
    parent = PastRun(start(), fingerprints=bytearray(b"1" * 8 + b"2" * 8))
    assert run.is_part_of(parent, ticks) is is_part


def test_only_the_first_change_by_hand_counts_and_its_ticks_only_grow() -> None:
    runs = PastRuns()
    assert not runs.changed_by_hand(0.5, 3)
    runs.counted_by_hand(3)
    runs.begin(start())
    runs.counted_by_hand(3)
    run = runs.find("")
    assert run is not None
    assert run.by_hand_ticks == 0
    assert runs.changed_by_hand(0.5, 7)
    assert not runs.changed_by_hand(0.9, 9)
    for ticks in (8, 7):
        runs.counted_by_hand(ticks)
        assert (run.by_hand_s, run.by_hand_ticks) == (0.5, 8)


def test_a_reset_begins_another_recording_of_the_same_run() -> None:
    runs = PastRuns()
    runs.begin(start())
    runs.name("abc")
    runs.said(entered(TELEOP))
    runs.reset("def")
    runs.said(entered(ForWorld(child_messages.Reset())))
    before, after = runs.find("abc"), runs.find("def")
    assert before is not None
    assert after is not None
    assert (before.replay(1.0).resets, len(before.inputs)) == (0, 1)
    assert (after.replay(1.0).resets, len(after.inputs)) == (1, 2)


def test_only_the_last_runs_are_known_and_none_of_another_world() -> None:
    runs = PastRuns()
    for number in range(MOST_RUNS + 2):
        runs.begin(start())
        runs.name(str(number))
    assert runs.find("1") is None
    assert runs.find("2") is not None
    runs.forget()
    assert runs.find("") is None
    runs.said(entered(TELEOP))  # of a run that is forgotten
    runs.name("x")
    runs.reset("x")
    assert runs.find("x") is None


def test_a_run_that_did_not_begin_is_forgotten() -> None:
    runs = PastRuns()
    runs.begin(start())
    runs.name("abc")
    runs.begin(start("/broken"))
    runs.drop_unborn()
    runs.drop_unborn()
    run = runs.find("")
    assert run is not None
    assert run.run == "abc"


def test_folders_of_changed_trees_stay_and_are_bounded() -> None:
    runs = PastRuns()
    for number in range(3):
        runs.begin(start(f"/first/{number}"))
        runs.name(str(number))
    assert runs.folders == {"/first/0", "/first/1", "/first/2"}
    for number in range(MOST_FOLDERS - 1):
        runs.said(entered(child_messages.ApplyApplication(app_dir=f"/changed/{number}")))
        runs.name("2")
    assert len(runs.folders) >= MOST_FOLDERS
    run = runs.find("2")
    assert run is not None
    assert run.refusal == ""
    runs.said(entered(child_messages.ApplyApplication(app_dir="/one/more")))
    assert "changed more than" in run.refusal
    assert run.folders == ()
    assert run.inputs == []
    runs.said(entered(TELEOP))
    assert run.inputs == []


@pytest.mark.parametrize(("limit", "words"), [("MOST_INPUT_BYTES", "by hand"), ("MOST_TICKS", "too long")])
def test_what_is_too_much_is_refused(monkeypatch: pytest.MonkeyPatch, limit: str, words: str) -> None:
    monkeypatch.setattr(past, limit, 3)
    run = PastRun(start())
    for _ in range(4):
        run.enter(entered(TELEOP))
        run.tick(Fingerprints(b"12345678"))
    assert words in run.refusal


def test_a_live_run_keeps_the_programs_that_it_had() -> None:
    runs = PastRuns()
    runs.changed(1.0, "/nothing")
    runs.begin(StartApplication("/app", 20.0))
    runs.name("live")
    assert (runs.names, runs.live_names) == (["live"], ["live"])
    runs.changed(2.0, "/two")
    runs.changed(4.0, "/four")
    run = runs.find("live")
    assert run is not None
    assert not run.is_exact
    assert [run.folder_at(t_s) for t_s in (0.0, 2.0, 3.9, 9.0)] == ["/app", "/two", "/two", "/four"]
    assert runs.folders == {"/app", "/two", "/four"}
    for number in range(MOST_FOLDERS):
        runs.changed(5.0, f"/{number}")
    assert (runs.names, runs.live_names) == ([], [])
    runs.begin(start())
    runs.name("exact")
    runs.changed(1.0, "/other")
    assert (runs.names, runs.live_names, runs.folders) == (["exact"], [], {"/app"})
