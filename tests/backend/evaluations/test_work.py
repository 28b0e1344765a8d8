"""The next work, and its user."""

from __future__ import annotations

from datetime import UTC, datetime
from uuid import UUID

from backend.evaluations import work, writes
from backend.evaluations.choices import JobState, WaitsFor
from backend.evaluations.executor_events import read_line
from backend.evaluations.models import Evaluation
from backend.evaluations.work import Place, in_turn
from tests.backend.evaluations.conftest import begin, done, session_for, store, wish

A, B = UUID(int=1), UUID(int=2)


def at(minute: int) -> datetime:
    return datetime(2026, 1, 1, 0, minute, tzinfo=UTC)


def test_the_next_turn_is_for_the_user_with_the_fewest_running_ones_and_then_for_the_oldest_wish():
    waiting = {Place(A, 1): at(1), Place(B, 1): at(2), Place(A, 2): at(5), Place(A, 3): at(4)}
    assert in_turn(waiting, [Place(B, 1)], {}) == [Place(A, 3), Place(A, 2), Place(A, 1)]
    assert in_turn(waiting, [], {}) == [Place(A, 1), Place(B, 1), Place(A, 3), Place(A, 2)]


def test_of_users_with_as_many_running_ones_who_had_a_turn_longest_ago_goes_first():
    waiting = {Place(A, 1): at(1), Place(B, 1): at(2), Place(A, 2): at(5), Place(A, 3): at(4)}
    turns = {1: at(9), 2: at(3)}
    assert in_turn(waiting, [], turns) == [Place(A, 3), Place(A, 2), Place(A, 1), Place(B, 1)]
    assert in_turn(waiting, [Place(B, 3)], turns) == [Place(A, 2), Place(A, 1), Place(B, 1), Place(A, 3)]


def test_the_last_turn_of_a_user_is_that_of_the_newest_session_for_evaluations(people):
    owner, editor = people.owner.user.pk, people.editor.user.pk
    session_for(people, state="ended", created_at=at(1))
    session_for(people, state="ended", created_at=at(4))
    session_for(people, "editor", kind="interactive", state="ended", created_at=at(2))
    places = [Place(people.project.id, user) for user in (owner, editor)]
    assert work.last_turns(places) == {owner: at(4)}


def test_a_replay_goes_first_then_what_runs_then_the_oldest(people):
    first, second = wish(people), wish(people)
    place = Place(people.project.id, people.owner.user.pk)
    assert work.next_of(place) == first
    begin(second)
    assert work.next_of(place) == second
    store(first, done(0))
    replay = writes.ask_replay(people.project.id, first.id, 1, 0, acting_user=people.owner.user)
    assert work.next_of(place) == replay
    assert work.has_replay(place)
    assert set(work.waiting_places()) == {place}
    assert work.next_of(Place(people.project.id, people.editor.user.pk)) is None


def test_a_user_without_processor_hours_waits(people, settings_of):
    found = wish(people)
    store(found, done(0))
    settings_of(evaluation_hours_a_day=0.0001)
    assert work.next_of(Place(people.project.id, people.owner.user.pk)) is None


def test_an_evaluation_says_what_it_waits_for(people, settings_of):
    waiting, running = wish(people), wish(people, "editor")
    begin(running)
    running.refresh_from_db()
    assert work.waits_for([waiting, running]) == {waiting.id: WaitsFor.TURN}
    session_for(people, "viewer", kind="interactive", state="queued")
    assert work.waits_for([waiting]) == {waiting.id: WaitsFor.USERS}
    store(waiting, done(0))
    settings_of(evaluation_hours_a_day=0.0001)
    assert work.waits_for([waiting]) == {waiting.id: WaitsFor.HOURS}
    assert work.waits_for([running]) == {}


def test_an_evaluation_waits_for_the_ray_cluster_that_starts_for_it(people, settings_of):
    first, second = wish(people), wish(people)
    session_for(people, state="starting", own_cluster=True)
    assert work.waits_for([first, second])[first.id] == WaitsFor.TURN  # this server makes none
    settings_of(launcher="kubernetes", evaluations="rayjob")
    assert work.waits_for([first, second]) == {first.id: WaitsFor.CLUSTER, second.id: WaitsFor.TURN}


def test_the_older_revision_runs_the_seeds_that_counted_after_the_newer_one(people):
    found = wish(people)
    assert work.next_side(found) == work.Side(1, [], [])
    begin(found, 3)
    store(found, done(0, wanted=3), done(1, "invalid", 2, 3))
    found.refresh_from_db()
    assert work.next_side(found) == work.Side(1, [(0, "success"), (1, "invalid")], [])
    store(found, done(2, "failure", 3, 3))
    found.refresh_from_db()
    assert work.next_side(found) is None
    Evaluation.objects.filter(id=found.id).update(older=0, state=JobState.WAITING)
    found.refresh_from_db()
    assert work.next_side(found) == work.Side(0, [], [0, 2])
    writes.store(found, 0, [(done(seed), read_line(done(seed))) for seed in (0, 2)])
    assert work.next_side(found) is None
