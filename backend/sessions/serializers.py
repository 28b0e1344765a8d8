"""Serializers of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rest_framework import serializers

from backend.sessions import queries
from backend.sessions.choices import SessionKind, SessionState

if TYPE_CHECKING:
    from backend.sessions.models import Session


class SessionSerializer(serializers.Serializer[Any]):
    """An executor that runs, or ran, a project."""

    id = serializers.UUIDField()
    kind = serializers.ChoiceField(choices=SessionKind.choices)
    project_id = serializers.UUIDField(allow_null=True, help_text="Null for an attached session.")
    target = serializers.CharField(help_text="The address of the program that it follows; else empty.")
    state = serializers.ChoiceField(choices=SessionState.choices)
    control_url = serializers.CharField()
    stream_url = serializers.CharField()
    error = serializers.CharField(help_text="Why it failed; else empty.")
    position = serializers.IntegerField(
        allow_null=True, help_text="Place in the queue, from 1, while it waits for one on the server."
    )
    created_at = serializers.DateTimeField()


class AttachSerializer(serializers.Serializer[Any]):
    """The program to follow."""

    address = serializers.CharField(
        max_length=260, help_text="HOST or HOST:PORT of its publisher of Groot2's protocol; the port is 1667."
    )


def presented(session: Session) -> dict[str, Any]:
    """Returns a session in the form for the API."""
    return {
        "id": str(session.id),
        "kind": session.kind,
        "project_id": session.project_id and str(session.project_id),
        "target": session.target,
        "state": session.state,
        "control_url": f"/ws/sessions/{session.id}/control",
        "stream_url": f"/ws/sessions/{session.id}/stream",
        "error": session.error,
        "position": queries.position(session),
        "created_at": session.created_at.isoformat(),
    }
