"""Reads of sessions."""

from __future__ import annotations

from datetime import timedelta

import pytest
from django.utils import timezone

from backend.core.problems import NotFoundError
from backend.sessions import queries
from backend.sessions.choices import SessionState
from backend.sessions.models import Session


@pytest.fixture
def session_of(api, user):
    def make(state, *, age_s=0.0):
        project = api.post("projects", {"name": f"P{Session.objects.count()}"}, expect=201)
        created = timezone.now() - timedelta(seconds=age_s)
        return Session.objects.create(project_id=project["id"], user=user, state=state, created_at=created)

    return make


def test_those_that_wait_are_counted_and_listed(session_of, user):
    later, first = session_of(SessionState.QUEUED), session_of(SessionState.QUEUED, age_s=60)
    ready = session_of(SessionState.READY)
    session_of(SessionState.ENDED)
    assert queries.counts()[SessionState.QUEUED] == 2
    assert len(queries.live_sessions()) == 3
    assert queries.sessions_of(user) == [first, later, ready]


def test_a_session_is_its_users(session_of, user):
    ended = session_of(SessionState.ENDED)
    assert queries.session(ended.id, user=user) == ended
    assert queries.live_session(ended.project_id, user=user) is None
    with pytest.raises(NotFoundError):
        queries.session(ended.project_id, user=user)
