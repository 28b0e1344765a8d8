"""Rounds: who gets a session, and who gives one up."""

from __future__ import annotations

from datetime import timedelta

import pytest
from django.utils import timezone

from backend.config.environment import environment
from backend.evaluations import rounds, writes
from backend.evaluations.choices import JobState
from backend.evaluations.models import Evaluation
from backend.projects.sharing import memberships
from backend.projects.storage import writes as projects
from backend.sessions.lifecycle import writes as sessions
from backend.sessions.models import Drain, Session
from backend.sessions.queries import start_timeout_s
from backend.workers.aside import sweeps
from tests.backend.evaluations.conftest import ROOM, begin, done, session_for, store, wish


@pytest.fixture(autouse=True)
def _nothing_starts(monkeypatch):
    """Sessions stay in the state in which they are made, and nobody reads them."""
    monkeypatch.setattr(sessions, "workers", type("Idle", (), {"submit": lambda *_: None}))
    monkeypatch.setattr(rounds, "collect", lambda *_: None)


def live():
    return list(Session.objects.filter(kind="evaluation", state__in=["starting", "ready"]))


def test_one_at_a_time_gets_a_session_and_the_others_wait(people):
    wish(people)
    wish(people, "editor")
    rounds.one_round()
    rounds.one_round()
    [session] = live()
    assert session.user == people.owner.user


def test_more_at_a_time_where_the_server_has_room(people, settings_of):
    settings_of(max_evaluations=2)
    wish(people)
    wish(people, "editor")
    rounds.one_round()
    assert len(live()) == 2


def test_a_place_is_kept_for_users_who_work(people, settings_of):
    settings_of(max_sessions=2, max_evaluations=5)
    wish(people)
    session_for(people, kind="interactive")
    rounds.one_round()
    assert live() == []
    Session.objects.update(state="ended")
    rounds.one_round()
    assert len(live()) == 1


def test_an_evaluation_ends_its_session_for_a_user_who_waits_and_continues_later(people):
    found = wish(people)
    begin(found)
    session_for(people)
    session_for(people, "editor", kind="interactive", state="queued")
    rounds.one_round()
    session = Session.objects.get(kind="evaluation")
    assert (session.state, session.error) == ("ended", "It gave its place to others.")
    assert Evaluation.objects.get().state == JobState.WAITING


def test_after_its_turn_an_evaluation_gives_its_place_to_another_user(people):
    first = wish(people)
    begin(first)
    mine = session_for(people)
    wish(people, "editor")
    rounds.one_round()
    assert live() == [mine]
    Session.objects.filter(id=mine.id).update(created_at=timezone.now() - rounds.TURN - timedelta(seconds=1))
    rounds.one_round()
    [session] = live()
    assert session.user == people.editor.user


def test_somebody_with_many_wishes_does_not_keep_another_user_waiting(people):
    """The owner's evaluations were all asked for earlier, and the owner's session gave its place to users."""
    for _ in range(3):
        wish(people)
    rounds.one_round()
    wish(people, "editor")
    session_for(people, "viewer", kind="interactive", state="queued")
    rounds.one_round()
    assert live() == []
    Session.objects.filter(kind="interactive").update(state="ended")
    users = []
    for _ in range(4):
        rounds.one_round()
        [session] = live()
        users.append(session.user.username)
        Session.objects.filter(id=session.id).update(state="ended")
    assert users == ["editor", "owner", "editor", "owner"]


def test_a_user_with_two_projects_gets_one_of_two_places_while_another_user_waits(people, settings_of):
    settings_of(max_evaluations=2)
    other = projects.create_project(
        {"evaluations/room.yaml": ROOM}, acting_user=people.owner.user, name="Second"
    )
    wish(people)
    writes.start(other.id, "room", 0, acting_user=people.owner.user)
    wish(people, "editor")
    rounds.one_round()
    assert sorted(session.user.username for session in live()) == ["editor", "owner"]


def test_who_lost_the_right_loses_the_evaluation(people):
    found = wish(people, "editor")
    memberships.unshare_with_person(people.project.id, "editor", acting_user=people.owner.user)
    rounds.one_round()
    found.refresh_from_db()
    assert found.state == JobState.FAILED
    assert found.error


def test_nothing_starts_before_an_upgrade(people, monkeypatch):
    wish(people)
    monkeypatch.setattr(rounds, "current_drain", Drain)
    rounds.one_round()
    assert live() == []


def test_a_round_is_asked_for_only_if_there_is_something_to_do(people, monkeypatch):
    asked = []
    monkeypatch.setattr(sweeps, "ask", lambda *work: asked.append(work))
    rounds.round_soon()
    assert asked == []
    found = wish(people)
    rounds.round_soon()
    assert asked == [("evaluations", rounds.one_round)]
    writes.finish(found, JobState.DONE)
    rounds.round_soon()
    assert len(asked) == 1


def test_an_evaluation_gets_a_ray_cluster_of_its_own_where_the_server_is_set_so(people, settings_of):
    wish(people)
    rounds.one_round()
    [session] = live()
    assert (session.own_cluster, start_timeout_s(session)) == (False, 30)
    Session.objects.update(state="ended")
    settings_of(launcher="kubernetes", evaluations="rayjob")
    rounds.one_round()
    [session] = live()
    assert (session.own_cluster, start_timeout_s(session)) == (True, 300)


def test_a_replay_needs_no_ray_cluster(people, settings_of):
    settings_of(launcher="kubernetes", evaluations="rayjob")
    found = wish(people)
    begin(found)
    store(found, done(0))
    writes.finish(found, JobState.DONE)
    writes.ask_replay(people.project.id, found.id, found.revision, 0, acting_user=people.owner.user)
    rounds.one_round()
    assert [session.own_cluster for session in live()] == [False]


def test_a_turn_begins_when_a_ray_cluster_may_have_started(people, settings_of):
    settings_of(launcher="kubernetes", evaluations="rayjob")
    first = wish(people)
    begin(first)
    mine = session_for(people)
    wish(people, "editor")
    late = timezone.now() - rounds.TURN - timedelta(seconds=1)
    Session.objects.filter(id=mine.id).update(created_at=late, own_cluster=True)
    rounds.one_round()
    assert live() == [mine]
    started = timedelta(seconds=environment().rayjob_start_timeout_s)
    Session.objects.filter(id=mine.id).update(created_at=late - started)
    rounds.one_round()
    assert [each.user for each in live()] == [people.editor.user]


def test_an_executor_that_is_lost_at_work_counts_as_a_try_once(people):
    first = wish(people)
    begin(first)
    lost = session_for(people)
    Session.objects.filter(id=lost.id).update(state="failed", error="It needed too much memory.")
    rounds.one_round()
    first.refresh_from_db()
    assert (first.tries, first.state) == (1, "waiting")
    rounds.one_round()
    first.refresh_from_db()
    assert first.tries == 1


def test_a_start_that_nobody_wants_any_more_is_ended(people):
    first = wish(people)
    mine = session_for(people, state="starting")
    writes.cancel(people.project.id, first.id, acting_user=people.owner.user)
    rounds.one_round()
    mine.refresh_from_db()
    assert (mine.state, mine.error) == ("ended", "Nothing is left to do.")
