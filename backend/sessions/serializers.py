"""Serializers of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rest_framework import serializers

from backend.sessions import queries
from backend.sessions.choices import SessionState

if TYPE_CHECKING:
    from backend.sessions.models import Session


class SessionSerializer(serializers.Serializer[Any]):
    """An executor that runs, or ran, a project."""

    id = serializers.UUIDField()
    project_id = serializers.UUIDField()
    state = serializers.ChoiceField(choices=SessionState.choices)
    control_url = serializers.CharField()
    stream_url = serializers.CharField()
    error = serializers.CharField(help_text="Why it failed; else empty.")
    position = serializers.IntegerField(
        allow_null=True, help_text="Place in the queue, from 1, while it waits for one on the server."
    )
    created_at = serializers.DateTimeField()


def presented(session: Session) -> dict[str, Any]:
    """Returns a session in the form for the API."""
    return {
        "id": str(session.id),
        "project_id": str(session.project_id),
        "state": session.state,
        "control_url": f"/ws/sessions/{session.id}/control",
        "stream_url": f"/ws/sessions/{session.id}/stream",
        "error": session.error,
        "position": queries.position(session),
        "created_at": session.created_at.isoformat(),
    }
