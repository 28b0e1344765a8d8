"""The stored runs that stay, those that are deleted, and those that are refused."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from django.utils import timezone

from backend.config.environment import environment
from backend.core.problems import NotFoundError
from backend.runs import queries, writes
from backend.runs.errors import NotRecordedError
from backend.runs.models import Run
from backend.sessions.choices import SessionKind, SessionState
from backend.sessions.models import Session
from tests.backend.runs.conftest import SAMPLE, keep
from tests.fakes.recordings import TOKEN, recordings

pytestmark = pytest.mark.usefixtures("manager")


def change(by, run, **values):
    return writes.change(run["project"], run["id"], values, acting_user=by.user)


def seen(by, project):
    return [run.name for run in queries.runs(project.id, user=by.user)]


def test_the_last_runs_stay_and_all_that_are_pinned(people, monkeypatch):
    monkeypatch.setattr(writes, "MOST_UNPINNED", 2)
    first = keep(people.owner, people.project, name="0").json() | {"project": people.project.id}
    change(people.owner, first, is_pinned=True)
    keep(people.editor, people.project, name="editor's")
    for number in range(1, 5):
        keep(people.owner, people.project, name=str(number))
    assert seen(people.owner, people.project) == ["0", "4", "3", "editor's"]


def test_runs_count_to_the_quota_of_the_one_who_keeps_them(people, monkeypatch):
    limits = environment().model_copy(update={"max_user_run_bytes": len(SAMPLE) + 10})
    monkeypatch.setattr("backend.runs.queries.environment", lambda: limits)
    assert keep(people.viewer, people.project).status_code == 201
    answer = keep(people.viewer, people.project)
    assert (answer.status_code, answer.json()["code"]) == (413, "quota_exceeded")
    assert "room for 10" in answer.json()["detail"]
    assert keep(people.owner, people.project).status_code == 201


def test_what_is_no_recording_is_not_stored(people, monkeypatch):
    with recordings(b"no recording" * 100) as address:
        session = SimpleNamespace(address=address, state=SessionState.READY)
        monkeypatch.setattr(writes, "live_session", lambda *_, **__: session)
        monkeypatch.setattr(writes, "manager_token", lambda _: TOKEN)
        answer = keep(people.owner, people.project)
    assert (answer.status_code, answer.json()["code"]) == (502, "executor_failed")
    assert "it does not begin as an MCAP file" in answer.json()["detail"]
    assert Run.objects.count() == 0


@pytest.mark.parametrize("session", [None, SimpleNamespace(state=SessionState.STARTING)])
def test_without_a_session_that_runs_nothing_is_kept(people, session, monkeypatch):
    monkeypatch.setattr(writes, "live_session", lambda *_, **__: session)
    with pytest.raises(NotRecordedError, match="No session of yours"):
        writes.source(people.project.id, acting_user=people.owner.user)


def test_a_run_of_an_attached_session_is_kept_in_the_project_that_was_made_of_its_tree(people, monkeypatch):
    owner = people.owner.user
    values = {"state": SessionState.READY, "address": "127.0.0.1:1", "created_at": timezone.now()}
    following = Session.objects.create(user=owner, kind=SessionKind.ATTACHED, target="robot:1667", **values)
    monkeypatch.setattr(writes, "manager_token", lambda session: f"of {session.id}")
    found = writes.source(people.project.id, acting_user=owner, attached=following.id)
    assert (found.address, found.token) == ("127.0.0.1:1", f"of {following.id}")
    with pytest.raises(NotFoundError):
        writes.source(people.project.id, acting_user=people.editor.user, attached=following.id)
    Session.objects.filter(id=following.id).update(state=SessionState.ENDED)
    with pytest.raises(NotRecordedError, match="No session of yours"):
        writes.source(people.project.id, acting_user=owner, attached=following.id)
    running = Session.objects.create(user=owner, project=people.project, **values)
    with pytest.raises(NotRecordedError, match="follows no other program"):
        writes.source(people.project.id, acting_user=owner, attached=running.id)


def test_two_that_are_kept_at_once_do_not_exceed_the_quota(people, monkeypatch):
    rooms = iter([len(SAMPLE), 0])  # another run was stored while this one was pulled
    monkeypatch.setattr(queries, "room", lambda _: next(rooms))
    answer = keep(people.owner, people.project)
    assert (answer.status_code, answer.json()["code"]) == (413, "quota_exceeded")
    assert Run.objects.count() == 0
