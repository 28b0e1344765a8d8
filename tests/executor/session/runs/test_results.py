"""The results of the runs of a session."""

from __future__ import annotations

import pytest

from executor import messages, recorder_messages
from executor.session.events import ChildSaid, RecordingWanted
from executor.session.ladder import State
from executor.session.runs.results import RunResults
from tests.executor.session.play import Play

BUMP = messages.Log("world", "warning", "scout bumped into the crate")
HIT = messages.Log("world", "warning", "scout was hit by the crate")
TALK = messages.Log("action", "info", "scout bumped into the crate")


@pytest.mark.parametrize(
    ("events", "result"),
    [
        ([messages.Finished("SUCCESS", "root_finished")], "success"),
        ([messages.Finished("FAILURE", "root_finished")], "failure"),
        ([messages.Finished("FAILURE", "action_raised")], "fault"),
        ([messages.Finished("IDLE", "process_died")], "fault"),
        ([messages.Finished("IDLE", "terminated")], "stopped"),
        ([BUMP, messages.Finished("IDLE", "terminated")], "collision"),
        ([HIT, TALK, messages.Finished("IDLE", "terminated")], "stopped"),
        ([BUMP, messages.Finished("SUCCESS", "root_finished")], "success"),
        ([messages.Finished("SUCCESS", "root_finished"), messages.Finished("IDLE", "terminated")], "success"),
        ([BUMP], None),
    ],
)
def test_the_first_end_of_a_run_is_its_result(events, result):
    results = RunResults()
    heard = [results.hear("a", event) for event in events]
    assert (results.of("a"), sum(heard)) == (result, int(result is not None))
    assert results.of("b") is None


def recorded_segment(play: Play) -> str:
    """Sends a segment of the present run as the recorder does; returns the run."""
    run = play.session.recording.run
    segment = messages.Segment(run, 0, 0, 0, 0.0, 1.0, 10)
    number = play.session.children.living["recorder"].number
    play.happens(ChildSaid("recorder", number, recorder_messages.Recorded(segment)))
    return run


def test_all_clients_hear_the_result_with_the_last_segment_of_the_run():
    play = Play()
    play.happens(RecordingWanted("/folder"))
    play.climb(State.APPLICATION_RUNNING)
    first = recorded_segment(play)
    assert play.sent("segment")[-1].result is None
    assert play.reply(play.command("restart_application")) == "ack"
    assert (play.sent("segment")[-1].run, play.sent("segment")[-1].result) == (first, "stopped")
    second = recorded_segment(play)
    play.child_says("application", "finished", status="SUCCESS", reason="root_finished")
    assert [(s.run, s.result) for s in play.session.snapshot().segments] == [
        (first, "stopped"),
        (second, "success"),
    ]
    recorded_segment(play)
    assert play.sent("segment")[-1].result == "success"


def test_a_run_that_is_left_for_a_branch_has_not_ended():
    play = Play()
    play.happens(RecordingWanted("/folder"))
    play.climb(State.APPLICATION_RUNNING)
    first = recorded_segment(play)
    play.session.recording.begin(parent=first, from_t=0.5)
    assert [s.result for s in play.session.snapshot().segments] == [None]
