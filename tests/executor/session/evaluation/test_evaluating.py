"""The evaluation beside the ladder: who hears of it, and what becomes of its process."""

from __future__ import annotations

from typing import Any

from executor import evaluation_messages
from executor.evaluation_events import EvaluationOutcome, EvaluationStarted
from executor.session.evaluation.evaluating import LAST_LINES
from executor.session.events import (
    ChildExited,
    ChildLooked,
    ChildSaid,
    ClientJoined,
    ClientLeft,
    Kill,
    RecordingWanted,
    Send,
    Spawn,
    Tell,
)
from executor.session.ladder import State
from tests.executor.session.play import Play

BEGUN = evaluation_messages.Started(
    workers=2, seed=0, wanted=3, sequential=False, duration_s=5.0, plan={"outlines": []}
)


def evaluate(play: Play, client: str = "d", **more: object) -> str:
    data = {"job": "a1", "app_zip_base64": "eA==", "evaluation": "room"} | more
    return play.command("evaluate", client, **data)


def done(seed: int) -> evaluation_messages.RunDone:
    return evaluation_messages.RunDone(seed, "{}", 1.0, 1, 3, 1.0, 0.2, 1.0, 4.0)


def says(play: Play, message: evaluation_messages.FromEvaluation) -> None:
    play.happens(ChildSaid("evaluation", play.session.children.living["evaluation"].number, message))


def told(play: Play) -> list[evaluation_messages.StartEvaluation]:
    kind = evaluation_messages.StartEvaluation
    return [e.message for e in play.effects if isinstance(e, Tell) and isinstance(e.message, kind)]


def answers(play: Play, request: str) -> list[str]:
    return [event.name for event in sent_as(play, request)]


def sent_as(play: Play, request: str) -> list[Send]:
    return [e for e in play.effects if isinstance(e, Send) and e.request == request]


def ends(play: Play) -> list[Any]:
    return [e.payload for e in play.effects if isinstance(e, Send) and e.name == "evaluation_ended"]


def test_outcomes_go_to_the_client_that_asked_as_answers_that_are_never_dropped():
    play = Play()
    request = evaluate(play, seeds=[4, 7])
    assert play.did(Spawn).count("evaluation") == 1
    [start] = told(play)
    assert (start.seeds, start.evaluation, start.record_to) == ([4, 7], "room", "")
    says(play, BEGUN)
    says(play, done(4))
    says(play, evaluation_messages.EvaluationDone(2))
    names = ["ack", "evaluation_started", "evaluation_outcome", "evaluation_ended"]
    assert answers(play, request) == names
    assert play.state is State.IDLE


def test_the_spare_world_and_application_make_room():
    play = Play()
    play.session.prestart()
    evaluate(play)
    assert {effect.kind for effect in play.effects if isinstance(effect, Kill)} == {"world", "application"}


def test_a_client_that_asks_again_gets_what_it_lacks_and_the_work_continues():
    play = Play()
    evaluate(play)
    says(play, BEGUN)
    says(play, done(0))
    says(play, done(1))
    play.happens(ClientLeft("d"))
    play.happens(ClientJoined("e"))
    says(play, done(2))
    request = evaluate(play, client="e", seeds=[1, 2])
    assert len(told(play)) == 1
    again = [event.payload for event in sent_as(play, request)][1:]
    assert isinstance(again[0], EvaluationStarted)
    assert [event.seed for event in again[1:] if isinstance(event, EvaluationOutcome)] == [1, 2]


def test_another_job_ends_the_one_before():
    play = Play()
    first = evaluate(play)
    evaluate(play, job="b2")
    assert answers(play, first)[-1] == "evaluation_ended"
    assert [event.end for event in ends(play)] == ["replaced"]
    assert len(told(play)) == 2


def test_a_recording_is_a_run_of_the_sessions_folder():
    play = Play()
    assert play.reply(evaluate(play, seeds=[3], record=True)) == "not_recorded"
    play.happens(RecordingWanted("/folder"))
    request = evaluate(play, seeds=[3], record=True)
    says(play, evaluation_messages.EvaluationDone(1))
    [ended] = ends(play)
    assert told(play)[0].record_to == f"/folder/{ended.run}/0.0.mcap"
    assert answers(play, request)[-1] == "evaluation_ended"


def test_a_process_that_dies_fails_the_job_with_its_last_words():
    play = Play()
    evaluate(play)
    number = play.session.children.living["evaluation"].number
    lines = ("one", "two", "three", "four")
    play.happens(ChildExited("evaluation", number, "was killed by SIGSEGV", lines))
    [ended] = ends(play)
    assert (ended.end, ended.message.splitlines()[0]) == ("failed", "The evaluation was killed by SIGSEGV.")
    assert ended.message.splitlines()[1:] == list(lines[-LAST_LINES:])
    evaluate(play)  # the same job begins again
    assert len(told(play)) == 2


def test_a_refused_evaluation_says_why():
    play = Play()
    evaluate(play)
    says(play, evaluation_messages.Refused("room.yaml:3:1: no"))
    [ended] = ends(play)
    assert (ended.end, ended.message) == ("refused", "room.yaml:3:1: no")


def test_its_process_is_not_taken_for_one_that_hangs():
    play = Play()
    evaluate(play)
    number = play.session.children.living["evaluation"].number
    for _ in range(100):
        play.now += 1.0
        play.happens(ChildLooked("evaluation", number, "S", 0.0, 0.0))
    assert "evaluation" in play.session.children.living
