"""Serializers of sessions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rest_framework import serializers

from backend.sessions import turns
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
    waits_for_own = serializers.BooleanField(
        help_text="Whether it waits until another session of its user ends, not until the server has room."
    )
    created_at = serializers.DateTimeField()


class OwnSessionSerializer(SessionSerializer):
    """A session of the user that waits, starts or runs."""

    project_name = serializers.CharField(help_text="Empty for an attached session.")


class OwnSessionListSerializer(serializers.Serializer[Any]):
    """The sessions of the user that wait, start or run, the oldest first."""

    items = OwnSessionSerializer(many=True)


class AttachSerializer(serializers.Serializer[Any]):
    """The program to follow."""

    address = serializers.CharField(
        max_length=260, help_text="HOST or HOST:PORT of its publisher of Groot2's protocol; the port is 1667."
    )


def presented(session: Session) -> dict[str, Any]:
    """Returns a session in the form for the API."""
    turn = turns.turn_of(session)
    return {
        "id": str(session.id),
        "kind": session.kind,
        "project_id": session.project_id and str(session.project_id),
        "target": session.target,
        "state": session.state,
        "control_url": f"/ws/sessions/{session.id}/control",
        "stream_url": f"/ws/sessions/{session.id}/stream",
        "error": session.error,
        "position": None if turn is None else turn.before + 1,
        "waits_for_own": turn is not None and turn.is_own,
        "created_at": session.created_at.isoformat(),
    }


def presented_own(session: Session) -> dict[str, Any]:
    """Returns a session of the user, with the name of its project."""
    return presented(session) | {"project_name": session.project.name if session.project else ""}
