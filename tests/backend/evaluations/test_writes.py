"""Writes of evaluations: the queue, outcomes that are stored once, and what cannot be."""

from __future__ import annotations

import threading

import pytest
from django.db import connection

from backend.accounts.writes import delete_account
from backend.evaluations import queries, writes
from backend.evaluations.choices import JobState
from backend.evaluations.errors import NoEvaluationError, WrongStateError
from backend.evaluations.models import Evaluation, Outcome, Replay
from backend.projects.storage.access import RoleTooLowError
from tests.backend.evaluations.conftest import begin, done, line, store, wish


def again(found):
    return Evaluation.objects.get(id=found.id)


def test_only_who_may_change_the_project_starts_and_ends_evaluations(people):
    with pytest.raises(RoleTooLowError):
        wish(people, "viewer")
    found = wish(people, "editor")
    for act in (writes.cancel, writes.resume, writes.delete):
        with pytest.raises(RoleTooLowError):
            act(people.project.id, found.id, acting_user=people.viewer.user)


def test_an_evaluation_that_is_not_there_is_refused_with_its_file(people):
    with pytest.raises(NoEvaluationError) as refused:
        wish(people, name="../room")
    assert "evaluations/../room.yaml" in refused.value.hint


def test_a_server_whose_only_place_is_kept_for_users_says_so(people, settings_of):
    settings_of(max_sessions=1)
    with pytest.raises(NoEvaluationError, match="one place"):
        wish(people)


def test_outcomes_are_stored_once_and_their_sum_is_that_of_the_last_message(people):
    found = wish(people)
    begin(found)
    assert store(found, done(0), done(1, "failure", 2))
    assert store(found, done(1, "success", 2), done(2, "success", 3))
    assert queries.known(found, 1) == [(0, "success"), (1, "failure"), (2, "success")]
    row = again(found)
    assert (row.state, row.seed, row.wanted, row.left_s) == ("running", 0, 4, 9.0)
    assert row.results["1"]["done"] == 3


def test_a_cancelled_evaluation_keeps_what_is_done_and_continues_when_it_is_resumed(people):
    found = wish(people)
    begin(found)
    store(found, done(0))
    writes.cancel(people.project.id, found.id, acting_user=people.editor.user)
    assert not store(found, done(1), done(2, "lost"))
    assert again(found).state == JobState.CANCELLED
    writes.finish(found, JobState.DONE)
    assert again(found).state == JobState.CANCELLED
    resumed = writes.resume(people.project.id, found.id, acting_user=people.editor.user)
    assert (resumed.state, resumed.attempt, resumed.user.username) == ("waiting", 2, "editor")
    assert [seed for seed, _ in queries.known(found, 1)] == [0, 1]  # the lost one runs again
    with pytest.raises(WrongStateError):
        writes.resume(people.project.id, found.id, acting_user=people.editor.user)
    writes.finish(found, JobState.DONE)  # of the attempt before
    assert again(found).state == JobState.WAITING


def test_what_until_left_over_goes(people):
    found = wish(people)
    begin(found, 6, sequential=True)
    found.refresh_from_db()
    store(found, *(done(seed, number=seed + 1, wanted=6) for seed in range(5)))
    writes.side_done(found, 1, 3)
    assert [seed for seed, _ in queries.known(found, 1)] == [0, 1, 2]
    assert again(found).results["1"] | {"done": 3, "wanted": 3} == again(found).results["1"]


def test_a_comparison_needs_outcomes_and_an_older_revision(people):
    found = wish(people)
    owner = people.owner.user
    with pytest.raises(NoEvaluationError):
        writes.compare(people.project.id, found.id, 1, acting_user=owner)
    Evaluation.objects.filter(id=found.id).update(revision=2)
    with pytest.raises(WrongStateError):
        writes.compare(people.project.id, found.id, 1, acting_user=owner)
    found.refresh_from_db()
    begin(found)
    store(found, done(0))
    writes.finish(found, JobState.DONE)
    compared = writes.compare(people.project.id, found.id, 1, acting_user=owner)
    assert (compared.older, compared.state) == (1, "waiting")


def test_an_executor_that_is_lost_three_times_fails_the_evaluation_unless_it_got_on(people):
    found = wish(people)
    begin(found)
    for _ in range(writes.MOST_TRIES - 1):
        writes.lost(again(found), "it died")
    waiting = again(found)
    assert (waiting.state, waiting.left_s, waiting.ended_at) == (JobState.WAITING, None, None)
    store(found, done(0))
    assert again(found).tries == 0
    for _ in range(writes.MOST_TRIES):
        writes.lost(again(found), "it died")
    failed = again(found)
    assert (failed.state, failed.error, failed.left_s) == ("failed", "it died", None)
    assert failed.ended_at is not None


def test_the_last_fifty_stay_and_those_that_run(people):
    first = wish(people)
    begin(first)
    for _ in range(writes.MOST_KEPT + 3):
        writes.finish(wish(people), JobState.DONE)
    wish(people)
    rows = Evaluation.objects.filter(project=people.project)
    assert rows.filter(id=first.id).exists()
    assert rows.count() == writes.MOST_KEPT + 1


def test_outcomes_beyond_their_size_end_an_evaluation_and_what_is_done_stays(people, settings_of):
    settings_of(max_outcome_bytes=2 * len(line(0)) + 10)
    first, second = wish(people), wish(people, "editor")
    begin(first)
    begin(second)
    assert store(first, done(0))
    assert store(second, done(0))
    assert not store(second, done(1))
    ended = again(second)
    assert (ended.state, len(queries.known(ended, 1))) == ("failed", 2)
    assert "What is done is kept. Delete an older evaluation" in ended.error
    owner = people.owner.user
    with pytest.raises(WrongStateError, match="take"):
        wish(people)
    with pytest.raises(WrongStateError, match="take"):
        writes.resume(people.project.id, second.id, acting_user=owner)
    writes.delete(people.project.id, first.id, acting_user=owner)
    assert writes.resume(people.project.id, second.id, acting_user=owner).state == "waiting"


def test_the_size_of_outcomes_is_measured_again_when_some_go(people):
    found = wish(people)
    begin(found)
    store(found, done(0), done(1, "invalid", 2))
    assert again(found).line_bytes == len(line(0)) + len(line(1, "invalid"))
    writes.finish(found, JobState.DONE)
    writes.resume(people.project.id, found.id, acting_user=people.owner.user)
    assert again(found).line_bytes == len(line(0))


def test_too_many_that_wait_are_refused(people):
    for _ in range(writes.MOST_WAITING):
        wish(people)
    with pytest.raises(WrongStateError, match=str(writes.MOST_WAITING)):
        wish(people)


def test_a_replay_is_asked_for_once_and_the_last_click_counts(people):
    found = wish(people)
    store(found, done(0), done(1))
    ask = people.project.id, found.id, 1
    viewer = people.viewer.user
    first = writes.ask_replay(*ask, 0, acting_user=viewer)
    assert writes.ask_replay(*ask, 0, acting_user=viewer).id == first.id
    second = writes.ask_replay(*ask, 1, acting_user=viewer)
    assert list(Replay.objects.all()) == [second]
    writes.replayed(second, JobState.FAILED, "no")
    assert writes.ask_replay(*ask, 1, acting_user=viewer).id != second.id


def test_with_the_account_or_the_project_all_goes(people):
    found = wish(people, "editor")
    store(found, done(0))
    delete_account(people.editor.user)
    assert not Evaluation.objects.exists()
    store(found, done(1))
    assert not Outcome.objects.exists()


@pytest.mark.django_db(transaction=True)
def test_two_servers_that_store_the_same_outcomes_store_them_once(people):
    found = wish(people)
    begin(found)

    def work():
        try:
            store(found, *(done(seed) for seed in range(20)))
        finally:
            connection.close()

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert Outcome.objects.count() == 20


def test_processor_hours_are_counted_for_a_day(people, settings_of):
    found = wish(people)
    store(found, *(done(seed) for seed in range(4)))
    assert writes.hours_left(people.owner.user)
    assert queries.used_hours(people.owner.user) == 12 / 3600
    settings_of(evaluation_hours_a_day=0.003)
    assert not writes.hours_left(people.owner.user)
    assert writes.hours_left(people.editor.user)
