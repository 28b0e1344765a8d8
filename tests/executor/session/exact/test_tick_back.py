"""The command `tick_back` in the session: where it leads, what becomes of branches, and its refusals."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import msgspec
import pytest

from executor import child_messages, messages
from executor.child_messages import Beat
from executor.session.events import ChildSaid, RecordingWanted, Send
from executor.session.exact.going_back import BY_HAND_BEFORE, FIRST, LIVE, RESET
from executor.session.exact.past import MOST_RUNS
from executor.session.ladder import HAS_APPLICATION, TABLE, State, is_legal
from tests.executor.session.debugger.test_python import Debugged
from tests.executor.session.exact.test_going_back import TELEOP, recorded
from tests.executor.session.exact.test_hosting import RUN, running, started
from tests.executor.session.exact.test_snapshots import arrive, taken, woken
from tests.executor.session.play import HELD, UNIVERSE, Play

if TYPE_CHECKING:
    from executor.replay_messages import Replay

TICK = b"12345678"
WRITE = msgspec.msgpack.encode(child_messages.SetBlackboard("", "nudge", 1))
BREAKPOINTS = msgspec.msgpack.encode(child_messages.SetBreakpoints(wanted=messages.SetBreakpoints([])))


def paused() -> Play:
    """Returns an exact run that is paused after three ticks."""
    play = recorded()
    assert play.reply(play.command("pause")) == "ack"
    return play


def held() -> Play:
    """Returns an exact run that is held within its fourth tick."""
    play = recorded()
    play.command("set_breakpoints")
    play.child_says("application", "held", **HELD)
    assert play.state is State.HELD
    return play


def stepped(play: Play, data: bytes = TICK) -> None:
    play.child_says("application", "fingerprints", data=data)
    assert play.reply(play.command("step")) == "ack"


def entered(play: Play, tick: int, message: bytes, hook: int = -1) -> None:
    play.child_says("application", "entered", input=[tick, 12 * tick, hook, message])


def back(play: Play) -> Replay:
    """Takes the run one tick back; returns how the run is made again."""
    assert play.reply(play.command("tick_back")) == "ack"
    assert play.state is State.PAUSED
    replay = started(play)[-1].replay
    assert replay is not None
    assert replay.until_s is None
    return replay


def runs(play: Play) -> list[str]:
    return play.session.snapshot().repeatable_runs


def refusal(play: Play) -> tuple[str, str]:
    before, request = play.state, play.command("tick_back")
    assert play.state is before
    (error,) = [e.payload for e in play.effects if isinstance(e, Send) and e.request == request]
    return error.code, error.message  # type: ignore[attr-defined]


def test_a_paused_run_goes_to_the_begin_of_its_last_tick() -> None:
    play = paused()
    first = play.session.recording.run
    assert back(play).fingerprints == TICK * 2
    assert (play.session.past.find("").ticks, play.session.past.find("").parent) == (2, first)
    assert [event.fraction for event in play.sent("going_back")] == [0.0, 1.0]
    assert "One tick back" in play.sent("log")[-1].text
    assert play.reply(play.command("resume")) == "ack"


def test_a_held_run_goes_to_the_begin_of_the_tick_before_the_held_one() -> None:
    play = held()
    assert back(play).fingerprints == TICK * 2
    assert play.session.snapshot().held is None
    assert "take_snapshot" not in play.told("application"), "a tick that is held cannot be kept"
    assert play.reply(play.command("step")) == "ack"


def debugged() -> Debugged:
    """Returns an exact run with the Python debugger, that has reported one tick."""
    play = Debugged()
    play.happens(RecordingWanted("/records"))
    play.command("run", **RUN)
    assert play.ask("initialize") == "ack"
    play.adapter_tells("initialized")
    assert play.ask("configurationDone") == "ack"
    play.child_says("application", "fingerprints", data=TICK)
    return play


def back_from_python(play: Debugged, last_words: bytes) -> None:
    """Takes a run that stands at a line of its fourth tick one tick back."""
    request = play.command("tick_back")
    assert play.reply(request) is None
    assert play.state is State.HELD
    number = play.session.children.living["application"].number
    play.obedient = False
    play.happens(ChildSaid("application", number, Beat(7, ticks=4)))
    assert "stop" in play.told("application")
    play.child_says("application", "fingerprints", data=last_words)
    play.obedient = True
    play.child_dies("application", "ended with exit code 0")
    assert play.reply(request) == "ack"
    assert started(play)[-1].replay.fingerprints == TICK * 2
    assert play.state is State.PAUSED


def test_a_run_that_stands_at_a_line_of_python_says_with_its_next_beat_in_which_tick() -> None:
    play = debugged()
    play.stop()
    back_from_python(play, TICK * 4)  # two ticks more than were whole


@pytest.mark.parametrize(("parent_ticks", "stays"), [(2, True), (3, False)])
def test_a_branch_stays_if_its_last_words_tell_whole_ticks_of_its_own(parent_ticks: int, stays: bool) -> None:
    play = debugged()
    play.child_says("application", "fingerprints", data=TICK * (parent_ticks - 1))
    assert play.reply(play.command("pause")) == "ack"
    back(play)
    branch = play.session.recording.run
    play.adapter_tells("initialized")
    assert play.ask("configurationDone") == "ack"
    assert play.reply(play.command("resume")) == "ack"
    play.stop()
    assert play.session.past.find("").ticks == parent_ticks - 1, (
        "it repeats its parent, as far as it has reported"
    )
    back_from_python(play, TICK * 3)
    assert (branch in runs(play)) is stays


def test_a_watch_that_calls_at_the_stop_leaves_the_way_back_by_one_tick() -> None:
    play = debugged()
    play.child_says("application", "beat", turns=7, ticks=1)  # older than the stop
    play.stop()
    assert play.ask("evaluate", expression="len(self.path)", frameId=1, context="watch") == "ack"
    back_from_python(play, TICK * 2)


def test_presses_lead_further_back_to_the_begin_and_leave_one_branch() -> None:
    play = paused()
    first = play.session.recording.run
    for ticks in (2, 1, 0):
        assert back(play).fingerprints == TICK * ticks
        (branch,) = play.session.snapshot().branches
        assert (branch.parent, branch.run) == (first, play.session.recording.run)
        assert runs(play) == [first, branch.run]
    assert refusal(play) == ("first_tick", FIRST)


def test_a_branch_that_is_thrown_away_makes_room_before_a_run_is_pushed_out() -> None:
    play = recorded()
    for _ in range(MOST_RUNS - 2):
        assert play.reply(play.command("run", **RUN)) == "ack"
    play.child_says("application", "fingerprints", data=TICK * 3)
    play.command("pause")
    back(play)
    kept = runs(play)
    assert len(kept) == MOST_RUNS
    back(play)
    assert runs(play) == [*kept[:-1], play.session.recording.run]
    assert kept[-1] not in runs(play)


def test_steps_forth_and_back_leave_one_branch_though_breakpoints_are_set() -> None:
    play = held()
    first = play.session.recording.run
    for _ in range(10):
        back(play)
        entered(play, 2, BREAKPOINTS)
        stepped(play)
    assert len(runs(play)) == 2
    assert runs(play)[0] == first


@pytest.mark.parametrize("change", ["other tick", "input", "name", "flag"])
def test_a_branch_with_something_of_its_own_stays(change: str) -> None:
    play = paused()
    back(play)
    branch = play.session.recording.run
    if change == "name":
        play.command("name_branch", run=branch, name="wider")
    elif change == "flag":
        play.command("flag", text="here")
    elif change == "input":
        entered(play, 2, WRITE)
    stepped(play, b"abcdefgh" if change == "other tick" else TICK)
    replay = back(play)
    assert play.sent("branch")[-1].parent == branch
    assert branch in runs(play)
    assert [each.message for each in replay.inputs] == [TELEOP] + [WRITE] * (change == "input")


def test_a_branch_without_what_entered_its_parent_stays() -> None:
    play = paused()
    entered(play, 1, WRITE)
    back(play)
    branch = play.session.recording.run
    play.session.past.find("").inputs.pop()
    back(play)
    assert branch in runs(play)


def test_the_newest_snapshot_that_is_not_too_late_continues() -> None:
    play = paused()
    taken(play, 1, ticks=1)
    taken(play, 2, ticks=2)
    taken(play, 3, ticks=3)
    request = play.command("tick_back")
    assert [wake.snapshot for wake in woken(play)] == [2]
    arrive(play, t=0.1, ticks=2, inputs=1)
    assert play.reply(request) == "ack"


def test_it_can_be_cancelled_and_done_again() -> None:
    play = paused()
    taken(play, 1, ticks=1)
    request = play.command("tick_back")
    assert play.reply(request) is None
    assert play.reply(play.command("cancel")) == "ack"
    assert play.reply(request) == "cancelled"
    assert play.reply(play.command("go_back")) is None


def test_a_live_run_is_refused_with_the_reason() -> None:
    play = running(universe=UNIVERSE)
    play.command("pause")
    assert refusal(play) == ("live_run", LIVE)


def test_it_does_not_cross_a_reset_of_the_world() -> None:
    play = paused()
    play.command("reset_world")
    entered(play, 3, msgspec.msgpack.encode(child_messages.ForWorld(child_messages.Reset())))
    assert refusal(play) == ("first_tick", RESET)
    stepped(play)
    assert back(play).fingerprints == TICK * 3


def test_a_run_that_is_not_kept_is_refused() -> None:
    play = paused()
    play.session.past.find("").refusal = "This run is too long"
    assert refusal(play)[0] == "not_repeatable"


def test_a_change_by_hand_is_not_passed_by_unless_it_is_undone() -> None:
    play = paused()
    play.session.past.changed_by_hand(0.15, 2)
    stepped(play)
    code, text = refusal(play)
    assert code == "changed_by_hand"
    assert "at 0.15 s" in text
    play = paused()
    play.session.past.changed_by_hand(0.15, 2)
    assert back(play).fingerprints == TICK * 2
    assert play.session.past.find("").by_hand_s is None


def test_a_change_by_hand_before_a_reset_is_named_so() -> None:
    play = paused()
    play.session.past.changed_by_hand(0.15, 2)
    play.command("reset_world")
    entered(play, 3, msgspec.msgpack.encode(child_messages.ForWorld(child_messages.Reset())))
    request = play.command("go_back", t=0.1)
    (error,) = [e.payload for e in play.effects if isinstance(e, Send) and e.request == request]
    assert error == messages.Error("changed_by_hand", BY_HAND_BEFORE, "Press Run.")
    stepped(play)
    stepped(play)
    assert refusal(play) == ("changed_by_hand", BY_HAND_BEFORE)


@pytest.mark.parametrize("state", list(State))
def test_each_state_of_an_exact_session(state: State) -> None:
    play = Play()
    if state in HAS_APPLICATION:
        play = {State.PAUSED: paused, State.HELD: held, State.APPLICATION_RUNNING: recorded}[state]()
    else:
        play.climb(state)
    reply = play.reply(play.command("tick_back"))
    assert reply == ("ack" if state in (State.PAUSED, State.HELD) else "wrong_state")
    assert play.state is (State.PAUSED if reply == "ack" else state)


@pytest.mark.parametrize("command", sorted(TABLE))
def test_every_command_while_an_exact_run_is_held_and_then_one_tick_back(command: str) -> None:
    play = held()
    reply = play.reply(play.command(command))
    assert (reply == "wrong_state") is not is_legal(State.HELD, command)
    if play.state in (State.PAUSED, State.HELD) and play.session.children.host is not None:
        assert play.reply(play.command("tick_back")) in ("ack", "first_tick")


@pytest.mark.parametrize("bad", [{"t": 1.0}, {"run": ""}])
def test_wrong_data_are_not_read(bad: dict[str, Any]) -> None:
    with pytest.raises(msgspec.ValidationError):
        Play().command("tick_back", **bad)
