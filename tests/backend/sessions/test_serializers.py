"""A session as the API shows it."""

from __future__ import annotations

from uuid import uuid4

from django.utils import timezone

from backend.sessions.choices import SessionState
from backend.sessions.models import Session
from backend.sessions.serializers import SessionSerializer, presented


def test_every_field_of_the_schema_is_there():
    session = Session(id=uuid4(), project_id=uuid4(), state=SessionState.READY, created_at=timezone.now())
    shown = presented(session)
    assert set(shown) == set(SessionSerializer().fields)
    assert shown["control_url"] == f"/ws/sessions/{session.id}/control"
    assert shown["position"] is None
